#pragma once

// An OpenGL context without a window. (With one: shared/render/window.h.)

#include <optional>
#include <string>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::render {

enum class GraphicsApi {
  kOpenGl33,    // core profile
  kOpenGlEs30,  // small boards; with EXT_color_buffer_float or EXT_color_buffer_half_float
};
std::string_view Name(GraphicsApi api);

// nullopt: OpenGL 3.3, and where no such context can be had, OpenGL ES 3.0.
using GraphicsChoice = std::optional<GraphicsApi>;

// Move-only; current on the thread that created it. Destroy it last, after all
// that was made with it.
class OffscreenContext {
 public:
  OffscreenContext(OffscreenContext&& other) noexcept;
  OffscreenContext& operator=(OffscreenContext&& other) noexcept;
  ~OffscreenContext();

  // Makes it current on the calling thread.
  Status MakeCurrent();

 private:
  friend Result<OffscreenContext> CreateOffscreenContext(GraphicsChoice choice);
  OffscreenContext(void* display, void* context) : display_(display), context_(context) {}

  void* display_ = nullptr;  // EGLDisplay
  void* context_ = nullptr;  // EGLContext
};

// Through EGL without a surface: works with a GPU and with Mesa in software. Fails where the
// driver lacks what pictures are drawn with.
Result<OffscreenContext> CreateOffscreenContext(GraphicsChoice choice = GraphicsApi::kOpenGl33);

// Of the current context: what it is, and who draws, as the driver calls it.
GraphicsApi CurrentGraphicsApi();
std::string GraphicsDeviceName();
// Whether that is software (Mesa's), and no graphics card.
bool DrawsOnProcessor(std::string_view device);

// What the current context's compiler of shaders keeps for the next ones goes back; it is made
// again when there are any. Takes milliseconds.
void ReleaseShaderCompiler();

}  // namespace lararium::render
