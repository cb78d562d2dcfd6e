#pragma once

// Uniforms and noise texture for CameraLook in the composite (shaders/include/camera_look.glsl).
// Private to render.

#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/shader_program.h"
#include "shared/render/passes/screen_bounds.h"
#include "shared/render/picture_view.h"
#include "shared/render/render_scene.h"

namespace lararium::render {

// Blur of people in one picture: equally weighted samples ("taps") along the motion and across it,
// as few as possible without visible gaps.
struct MotionBlur {
  glm::mat3 previous_from_pixel = glm::mat3(1.0f);
  float shutter = 0.0f;  // 0: motion is too small to be visible
  int taps_along = 1;
  int taps_across = 1;
  float lens_spread = 0.0f;  // pixels
  float lens_variance = 0.0f;
  float tap_stretch = 1.0f;
  int reach = 0;  // pixels by which the blur extends beyond the drawn people
};

// depth: distance of people along the view, metres. people: pixels in which they are drawn.
MotionBlur MotionBlurOf(const RenderScene& scene,
                        const PictureView& view,
                        const PixelBounds& people,
                        float depth);

class LookPass {
 public:
  static constexpr uint32_t kUnit = 10;  // texture unit of the noise

  // Sets the uniforms of composite, which must be the program in use. people: pixels in which
  // people are visible, blur included.
  void BindFor(const ShaderProgram& composite,
               const CameraLook& look,
               const MotionBlur& motion_blur,
               const PixelBounds& people);

 private:
  void MakeNoiseTile();

  GlTexture noise_tile_;  // created on first use
};

// Returns bounds grown by `by` pixels on each side, clipped to the picture.
PixelBounds Widened(const PixelBounds& bounds, int by, const ImageSize& size);

}  // namespace lararium::render
