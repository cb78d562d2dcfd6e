#pragma once

// An OpenGL context without a window. (With one: shared/render/window.h.)

#include <string>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::render {

enum class GraphicsApi {
  kOpenGl33,    // core profile
  kOpenGlEs30,  // small boards; also what shaders must compile as
};

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
  friend Result<OffscreenContext> CreateOffscreenContext(GraphicsApi api);
  OffscreenContext(void* display, void* context) : display_(display), context_(context) {}

  void* display_ = nullptr;  // EGLDisplay
  void* context_ = nullptr;  // EGLContext
};

// Through EGL without a surface: works with a GPU and with Mesa in software.
Result<OffscreenContext> CreateOffscreenContext(GraphicsApi api = GraphicsApi::kOpenGl33);

// Who draws, as the driver of the current context calls it.
std::string GraphicsDeviceName();
// Whether that is software (Mesa's), and no graphics card.
bool DrawsOnProcessor(std::string_view device);

// What the current context's compiler of shaders keeps for the next ones goes back; it is made
// again when there are any. Takes milliseconds.
void ReleaseShaderCompiler();

}  // namespace lararium::render
