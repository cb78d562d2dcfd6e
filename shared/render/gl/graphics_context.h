#pragma once

// An OpenGL context without a window. For one with a window see shared/render/gl/window.h.

#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "shared/core/status.h"

namespace lararium::render {

enum class GraphicsApi {
  kOpenGl33,    // core profile
  kOpenGlEs30,  // small boards; needs EXT_color_buffer_float or EXT_color_buffer_half_float
};
std::string_view Name(GraphicsApi api);

// nullopt: OpenGL 3.3, or OpenGL ES 3.0 if there is no such context.
using GraphicsChoice = std::optional<GraphicsApi>;

// Move-only. It is current on the thread that created it. Destroy it after all objects that were
// created in it. If other threads of the process draw as well, each takes turns (DrawingTurn).
class OffscreenContext {
 public:
  OffscreenContext(OffscreenContext&& other) noexcept { *this = std::move(other); }
  OffscreenContext& operator=(OffscreenContext&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(context_, other.context_);
    std::swap(draws_on_processor_, other.draws_on_processor_);
    return *this;
  }
  ~OffscreenContext();

  // Makes the context current on the calling thread.
  Status MakeCurrent();

 private:
  friend Result<OffscreenContext> CreateOffscreenContext(GraphicsChoice choice);
  friend class DrawingTurn;
  OffscreenContext(void* display, void* context) : display_(display), context_(context) {}

  void* display_ = nullptr;          // EGLDisplay
  void* context_ = nullptr;          // EGLContext
  bool draws_on_processor_ = false;  // See DrawsOnProcessor.
};

// While one exists, its thread is the only one that draws offscreen, if Mesa's software renderer
// draws: up to version 22.3 at least, that walks through what other contexts are about to draw
// without locking it. A graphics card lets all threads draw. The context must be current, and must
// not be destroyed meanwhile.
class DrawingTurn {
 public:
  explicit DrawingTurn(const OffscreenContext& context);
  ~DrawingTurn();
  DrawingTurn(const DrawingTurn&) = delete;
  DrawingTurn& operator=(const DrawingTurn&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
};

// Uses EGL without a surface, which works with a GPU and with Mesa's software renderer. Fails if
// the driver lacks a feature that drawing needs.
Result<OffscreenContext> CreateOffscreenContext(GraphicsChoice choice = GraphicsApi::kOpenGl33);

// The kind of the current context, and the name that its driver gives the graphics device.
GraphicsApi CurrentGraphicsApi();
std::string GraphicsDeviceName();
// True if a device of this name is Mesa's software renderer, not a graphics card.
bool DrawsOnProcessor(std::string_view device);

// Frees the memory that the shader compiler of the current context keeps. If more shaders are
// compiled later, it is allocated again. Takes milliseconds.
void ReleaseShaderCompiler();

}  // namespace lararium::render
