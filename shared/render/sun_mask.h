#pragma once

// How much of the sun people and props see, for every pixel of the picture: worked out once
// for the nearest of them there, however many triangles and samples share the pixel. What
// lies behind in the same pixel takes it from there. Private to render.

#include <span>

#include "shared/core/status.h"
#include "shared/render/gl_object.h"
#include "shared/render/model_pass.h"
#include "shared/render/picture_view.h"
#include "shared/render/screen_bounds.h"
#include "shared/render/shader_program.h"
#include "shared/render/sun_pass.h"

namespace lararium::render {

class SunMask {
 public:
  static constexpr uint32_t kUnit = SunPass::kFirstUnit + SunPass::kUnits;

  static Result<SunMask> Create();

  // Fills the mask within bounds, or does nothing where there is no sun.
  Status Draw(const PictureView& view,
              const PixelBounds& bounds,
              std::span<const ModelDraw> draws,
              const SunPass& sun,
              ModelPass& models);

  // As sun_seen, for the program in use.
  void BindFor(const ShaderProgram& shaders) const;

 private:
  Status Prepare(const ImageSize& size);

  ShaderProgram shaders_;
  GlVertexArray no_vertices_;
  ImageSize size_;
  GlTexture depth_;
  GlFramebuffer depth_framebuffer_;
  GlTexture seen_;
  GlFramebuffer seen_framebuffer_;
};

}  // namespace lararium::render
