#pragma once

// The visible share of the sun, for every pixel of people and props. It is computed once per pixel
// for the nearest surface, independent of how many triangles and samples share the pixel. Surfaces
// behind it in the same pixel use the same value. Private to render.

#include <span>

#include "shared/core/status.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/shader_program.h"
#include "shared/render/passes/model_pass.h"
#include "shared/render/passes/screen_bounds.h"
#include "shared/render/passes/sun_pass.h"
#include "shared/render/picture_view.h"

namespace lararium::render {

class SunMask {
 public:
  static constexpr uint32_t kUnit = SunPass::kFirstUnit + SunPass::kUnits;

  static Result<SunMask> Create();

  // Fills the mask within bounds; does nothing if there is no sun.
  Status Draw(const PictureView& view,
              const PixelBounds& bounds,
              std::span<const ModelDraw> draws,
              const SunPass& sun,
              ModelPass& models);

  // Binds the mask as the uniform sun_seen of shaders, which must be the program in use.
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
