// Without this, EGL's header includes that of X11, which is not needed here.
#define EGL_NO_X11
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>
#include <string_view>

#include "shared/core/memory.h"
#include "shared/render/gl/graphics_choice.h"
#include "shared/render/gl/graphics_context.h"

namespace lararium::render {
namespace {

constexpr std::string_view kContextPlace = "off-screen graphics";
constexpr std::string_view kRemedy = "install libegl1 and libgl1-mesa-dri";

bool InitializeDisplay(EGLDisplay display) {
  return display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE;
}

bool HasClientExtension(const char* name) { return epoxy_has_egl_extension(EGL_NO_DISPLAY, name); }

// Returns the first GPU that can be initialised; EGL_NO_DISPLAY: there is none, or the environment
// variable LIBGL_ALWAYS_SOFTWARE is set. The default display is not sufficient: on a machine with
// several drivers it may belong to Mesa's software renderer.
EGLDisplay OpenGpu() {
  if (std::getenv("LIBGL_ALWAYS_SOFTWARE") != nullptr ||
      !HasClientExtension("EGL_EXT_platform_device") ||
      !HasClientExtension("EGL_EXT_device_enumeration") ||
      !HasClientExtension("EGL_EXT_device_query")) {
    return EGL_NO_DISPLAY;
  }
  std::array<EGLDeviceEXT, 16> devices = {};
  EGLint count = 0;
  if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) {
    return EGL_NO_DISPLAY;
  }
  for (EGLDeviceEXT device : std::span(devices).first(static_cast<size_t>(count))) {
    const char* extensions = eglQueryDeviceStringEXT(device, EGL_EXTENSIONS);
    if (extensions != nullptr &&
        std::string_view(extensions).find("EGL_MESA_device_software") != std::string_view::npos) {
      continue;
    }
    const EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
    if (InitializeDisplay(display)) {
      return display;
    }
  }
  return EGL_NO_DISPLAY;
}

Result<EGLDisplay> OpenDisplay() {
  if (const EGLDisplay gpu = OpenGpu(); gpu != EGL_NO_DISPLAY) {
    return gpu;
  }
  if (HasClientExtension("EGL_MESA_platform_surfaceless") &&
      HasClientExtension("EGL_EXT_platform_base")) {
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (InitializeDisplay(display)) {
      return display;
    }
  }
  const EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (InitializeDisplay(display)) {
    return display;
  }
  return Status::Error(kContextPlace, "EGL does not start", kRemedy);
}

Result<EGLContext> CreateContext(EGLDisplay display, GraphicsApi api) {
  const bool desktop = api == GraphicsApi::kOpenGl33;
  const EGLint config_attributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE,
                                      desktop ? EGL_OPENGL_BIT : EGL_OPENGL_ES3_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglBindAPI(desktop ? EGL_OPENGL_API : EGL_OPENGL_ES_API) != EGL_TRUE ||
      eglChooseConfig(display, config_attributes, &config, 1, &count) != EGL_TRUE || count == 0) {
    return Status::Error(kContextPlace, "the driver offers no suitable configuration", kRemedy);
  }
  const EGLint desktop_attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                       3,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       3,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                       EGL_NONE};
  const EGLint es_attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0,
                                  EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT,
                                              desktop ? desktop_attributes : es_attributes);
  if (context == EGL_NO_CONTEXT) {
    return Status::Error(kContextPlace, "the driver has no " + std::string(Name(api)), kRemedy);
  }
  return context;
}

}  // namespace

Status CheckMemory() {
  // A show of two people took 370 MB with Mesa's software renderer.
  constexpr uint64_t kDriverBytes = 400'000'000;
  return RequireAddressSpace(kDriverBytes, "graphics");
}

Result<OffscreenContext> CreateOffscreenContext(GraphicsChoice choice) {
  LARARIUM_RETURN_IF_ERROR(CheckMemory());
  LARARIUM_ASSIGN_OR_RETURN(const EGLDisplay display, OpenDisplay());
  return CreateChosen(choice, [display](GraphicsApi api) -> Result<OffscreenContext> {
    LARARIUM_ASSIGN_OR_RETURN(const EGLContext egl_context, CreateContext(display, api));
    OffscreenContext context(display, egl_context);
    LARARIUM_RETURN_IF_ERROR(context.MakeCurrent());
    context.draws_on_processor_ = DrawsOnProcessor(GraphicsDeviceName());
    return context;
  });
}

// The EGL display is kept, because the whole process shares it.
OffscreenContext::~OffscreenContext() {
  if (context_ == nullptr) {
    return;
  }
  if (eglGetCurrentContext() == context_) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(display_, context_);
}

Status OffscreenContext::MakeCurrent() {
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    return Status::Error(kContextPlace, "the context cannot be used without a surface", kRemedy);
  }
  return Status();
}

}  // namespace lararium::render
