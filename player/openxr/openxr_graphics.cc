#include "player/openxr/openxr_graphics.h"

#include <epoxy/glx.h>

#define XR_USE_PLATFORM_XLIB
#define XR_USE_GRAPHICS_API_OPENGL
#include <openxr/openxr.h>
#include <openxr/openxr_platform.h>

namespace lararium::player {
namespace {

// The configuration of a context; nullptr: the driver does not report it.
GLXFBConfig ConfigOf(Display* display, GLXContext context) {
  int id = 0;
  int screen = 0;
  glXQueryContext(display, context, GLX_FBCONFIG_ID, &id);
  glXQueryContext(display, context, GLX_SCREEN, &screen);
  const int attributes[] = {GLX_FBCONFIG_ID, id, 0};
  int count = 0;
  GLXFBConfig* configs = glXChooseFBConfig(display, screen, attributes, &count);
  GLXFBConfig config = count > 0 ? configs[0] : nullptr;
  if (configs != nullptr) {
    XFree(configs);
  }
  return config;
}

}  // namespace

std::shared_ptr<const void> CurrentGraphicsBinding() {
  auto binding = std::make_shared<XrGraphicsBindingOpenGLXlibKHR>();
  binding->type = XR_TYPE_GRAPHICS_BINDING_OPENGL_XLIB_KHR;
  binding->xDisplay = glXGetCurrentDisplay();
  binding->glxContext = glXGetCurrentContext();
  binding->glxDrawable = glXGetCurrentDrawable();
  if (binding->xDisplay == nullptr || binding->glxContext == nullptr) {
    return nullptr;
  }
  binding->glxFBConfig = ConfigOf(binding->xDisplay, binding->glxContext);
  int visual = 0;
  if (binding->glxFBConfig == nullptr ||
      glXGetFBConfigAttrib(binding->xDisplay, binding->glxFBConfig, GLX_VISUAL_ID, &visual) != 0) {
    return nullptr;
  }
  binding->visualid = static_cast<uint32_t>(visual);
  return binding;
}

}  // namespace lararium::player
