#include "shared/render/gl/graphics_context.h"

#include <epoxy/gl.h>

#include <mutex>
#include <string>
#include <string_view>

#include "shared/render/gl/graphics_choice.h"

namespace lararium::render {
namespace {

// Locked by the thread that draws with Mesa's software renderer.
std::mutex drawing_on_processor;

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
