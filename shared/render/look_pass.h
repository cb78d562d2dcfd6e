#pragma once

// The composite's share of CameraLook (shaders/include/camera_look.glsl). Private to render.

#include "shared/render/gl_object.h"
#include "shared/render/picture_view.h"
#include "shared/render/render_scene.h"
#include "shared/render/screen_bounds.h"
#include "shared/render/shader_program.h"

namespace lararium::render {

// How people are to be smeared in one picture: evenly weighted taps along the motion and
// across it, so few that their gaps cannot be seen.
struct Smear {
  glm::mat3 previous_from_pixel = glm::mat3(1.0f);
  float shutter = 0.0f;  // 0: nothing moves far enough to be seen
  int taps_along = 1;
  int taps_across = 1;
  float lens_spread = 0.0f;  // pixels
  float lens_variance = 0.0f;
  float tap_stretch = 1.0f;
  int reach = 0;  // pixels by which people may be seen beyond where they are drawn
};

// depth: how far away people are, along the view. people: where they are drawn.
Smear SmearOf(const RenderScene& scene,
              const PictureView& view,
              const PixelBounds& people,
              float depth);

class LookPass {
 public:
  static constexpr uint32_t kUnit = 10;  // texture unit of the noise

  // Of the program in use. people: where they are seen, smears included.
  void BindFor(const ShaderProgram& composite,
               const CameraLook& look,
               const Smear& smear,
               const PixelBounds& people);

 private:
  void MakeNoiseTile();

  GlTexture noise_tile_;  // made when it is first wanted
};

// Within the picture.
PixelBounds Widened(const PixelBounds& bounds, int by, const ImageSize& size);

}  // namespace lararium::render
