#include "shared/render/gl/graphics_context.h"

// Without this, EGL's header includes that of X11, which is not needed here.
#define EGL_NO_X11
#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "shared/core/memory.h"
#include "shared/render/gl/graphics_choice.h"

namespace lararium::render {
namespace {

constexpr std::string_view kContextPlace = "off-screen graphics";
constexpr std::string_view kRemedy = "install libegl1 and libgl1-mesa-dri";

// Locked by the thread that draws with Mesa's software renderer.
std::mutex drawing_on_processor;

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

std::string_view Name(GraphicsApi api) {
  return api == GraphicsApi::kOpenGl33 ? "OpenGL 3.3" : "OpenGL ES 3.0";
}

// OpenGL ES 3.0 needs an extension to draw into floating-point images.
Status CheckDriver() {
  if (CurrentGraphicsApi() == GraphicsApi::kOpenGlEs30 &&
      !epoxy_has_gl_extension("GL_EXT_color_buffer_float") &&
      !epoxy_has_gl_extension("GL_EXT_color_buffer_half_float")) {
    return Status::Error("graphics",
                         "OpenGL ES 3.0 of " + GraphicsDeviceName() +
                             " has neither GL_EXT_color_buffer_float nor "
                             "GL_EXT_color_buffer_half_float",
                         "update the driver, or play with --graphics gl");
  }
  return Status();
}

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

OffscreenContext::OffscreenContext(OffscreenContext&& other) noexcept
    : display_(other.display_),
      context_(std::exchange(other.context_, nullptr)),
      draws_on_processor_(other.draws_on_processor_) {}

OffscreenContext& OffscreenContext::operator=(OffscreenContext&& other) noexcept {
  std::swap(display_, other.display_);
  std::swap(context_, other.context_);
  std::swap(draws_on_processor_, other.draws_on_processor_);
  return *this;
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

DrawingTurn::DrawingTurn(const OffscreenContext& context) {
  if (context.draws_on_processor_) {
    lock_ = std::unique_lock(drawing_on_processor);
  }
}

DrawingTurn::~DrawingTurn() {
  if (lock_.owns_lock()) {
    glFinish();  // Threads of the driver draw until then.
  }
}

GraphicsApi CurrentGraphicsApi() {
  return epoxy_is_desktop_gl() ? GraphicsApi::kOpenGl33 : GraphicsApi::kOpenGlEs30;
}

std::string GraphicsDeviceName() {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name == nullptr ? "unknown" : reinterpret_cast<const char*>(name);
}

bool DrawsOnProcessor(std::string_view device) {
  return device.find("llvmpipe") != std::string_view::npos ||
         device.find("softpipe") != std::string_view::npos;
}

void ReleaseShaderCompiler() { glReleaseShaderCompiler(); }

}  // namespace lararium::render
