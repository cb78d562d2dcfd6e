#pragma once

// Scales a picture to the size of a target, up or down. Private to render.

#include <opencv2/core/mat.hpp>

#include "shared/core/status.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/gl/shader_program.h"

namespace lararium::render {

class Upscaler {
 public:
  enum class Way {
    kShaders,
    // For software renderers: with vector instructions on bytes it takes a third of the time of
    // their shaders. With a graphics card it would be slow, because the card has to wait for it.
    kProcessor,
  };
  static Result<Upscaler> Create(Way way);
  // Chooses the way that is faster in the current context.
  static Result<Upscaler> Create();

  // Fills the target by bilinear interpolation. Both ways agree within one step of 8 bits.
  void Upscale(const RenderTarget& picture, const RenderTarget& target);

 private:
  void ByShaders(const RenderTarget& picture, const RenderTarget& target) const;
  void ByProcessor(const RenderTarget& picture, const RenderTarget& target);

  Way way_ = Way::kShaders;
  ShaderProgram shaders_;
  GlVertexArray no_vertices_;
  cv::Mat picture_;  // RGBA, kept between calls
  cv::Mat upscaled_;
};

}  // namespace lararium::render
