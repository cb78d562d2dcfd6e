#include <emscripten/html5_webgl.h>

#include "shared/render/gl/graphics_choice.h"
#include "shared/render/gl/graphics_context.h"

// In a browser a context belongs to a canvas, which the page gives the id "lararium".

namespace lararium::render {
namespace {

EMSCRIPTEN_WEBGL_CONTEXT_HANDLE HandleOf(void* context) {
  return reinterpret_cast<EMSCRIPTEN_WEBGL_CONTEXT_HANDLE>(context);
}

}  // namespace

// Nothing tells how much memory the browser's driver gets.
Status CheckMemory() { return Status(); }

Result<OffscreenContext> CreateOffscreenContext(GraphicsChoice /*choice*/) {
  return CreateChosen(GraphicsApi::kOpenGlEs30, [](GraphicsApi) -> Result<OffscreenContext> {
    EmscriptenWebGLContextAttributes attributes;
    emscripten_webgl_init_context_attributes(&attributes);
    attributes.majorVersion = 2;
    // People are drawn with samples of their own, and finished pictures are copied to the canvas,
    // which one with samples would refuse.
    attributes.antialias = EM_FALSE;
    attributes.alpha = EM_FALSE;
    attributes.depth = EM_FALSE;
    const EMSCRIPTEN_WEBGL_CONTEXT_HANDLE made =
        emscripten_webgl_create_context("#lararium", &attributes);
    if (made <= 0) {
      return Status::Error("graphics", "the browser gives no WebGL 2",
                           "allow hardware acceleration in its settings, or use another browser");
    }
    OffscreenContext context(nullptr, reinterpret_cast<void*>(made));
    LARARIUM_RETURN_IF_ERROR(context.MakeCurrent());
    return context;
  });
}

OffscreenContext::~OffscreenContext() {
  if (context_ != nullptr) {
    emscripten_webgl_destroy_context(HandleOf(context_));
  }
}

Status OffscreenContext::MakeCurrent() {
  if (emscripten_webgl_make_context_current(HandleOf(context_)) != EMSCRIPTEN_RESULT_SUCCESS) {
    return Status::Error("graphics", "the browser has lost the drawing context",
                         "load the page again");
  }
  return Status();
}

}  // namespace lararium::render
