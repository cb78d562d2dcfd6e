#include "shared/render/passes/look_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "shared/core/random.h"

namespace lararium::render {
namespace {

constexpr int kTile = 256;  // width and height of the noise texture
constexpr float kNoiseRange = 4.0f;
constexpr float kLongestSmear = 24.0f;  // pixels
constexpr float kWidestLens = 4.0f;
// Motions shorter than this, in pixels, do not blur edges visibly.
constexpr float kShortestSmear = 0.7f;
constexpr float kTapGap = 1.5f;  // pixels; taps are bilinear
constexpr int kMostTaps = 16;
// Variance of linear interpolation in squared pixels, averaged over positions between two pixels.
constexpr float kEnlargedVariance = 1.0f / 6.0f;

// The longest motion of a point within bounds since the last frame, in pixels. The corners are
// sufficient, because the map is nearly affine.
float LongestMotion(const glm::mat3& previous_from_pixel, const PixelBounds& b) {
  float longest = 0.0f;
  for (const glm::vec2 corner :
       std::array<glm::vec2, 4>{glm::vec2(b.left, b.bottom), glm::vec2(b.right, b.bottom),
                                glm::vec2(b.left, b.top), glm::vec2(b.right, b.top)}) {
    const glm::vec3 before = previous_from_pixel * glm::vec3(corner, 1.0f);
    const glm::vec2 motion = corner - glm::vec2(before) / before.z;
    longest = before.z > 1e-6f ? std::max(longest, glm::length(motion)) : kLongestSmear;
  }
  return longest;
}

int TapsOver(float pixels) {
  return std::clamp(static_cast<int>(std::ceil(pixels / kTapGap)), 2, kMostTaps);
}

// n equal taps over a length have a smaller variance than a box of that length. The result is the
// factor on the length that corrects this.
float StretchOf(int taps) {
  return 1.0f / std::sqrt(1.0f - 1.0f / static_cast<float>(taps * taps));
}

}  // namespace

MotionBlur MotionBlurOf(const RenderScene& scene,
                        const PictureView& view,
                        const PixelBounds& people,
                        float depth) {
  const CameraLook& look = scene.look;
  MotionBlur motion_blur;
  const float scale = static_cast<float>(view.size.width) / static_cast<float>(view.most.width);
  const float in_picture = std::clamp(look.blur_px, 0.0f, kWidestLens);
  // Upscaling a smaller layer softens it too.
  const float enlarged = scale < 1.0f ? kEnlargedVariance : 0.0f;
  motion_blur.lens_variance = std::max(scale * scale * in_picture * in_picture - enlarged, 0.0f);
  const float lens_box = std::sqrt(12.0f * motion_blur.lens_variance);
  if (motion_blur.lens_variance > 1e-4f && motion_blur.lens_variance <= 1.0f) {
    // Two bilinear taps at +-d from the centre of a texel have the variance d, for d up to 1.
    motion_blur.taps_across = 2;
    motion_blur.lens_spread = 4.0f * motion_blur.lens_variance;
  } else if (motion_blur.lens_variance > 1.0f) {
    motion_blur.taps_across = TapsOver(lens_box);
    motion_blur.lens_spread = lens_box * StretchOf(motion_blur.taps_across);
  }
  motion_blur.taps_along = motion_blur.taps_across;
  float longest = 0.0f;
  if (look.previous_camera_from_stage && scene.camera_from_stage && look.shutter > 0.0f &&
      !people.empty()) {
    motion_blur.previous_from_pixel = PreviousFromPixel(
        *look.previous_camera_from_stage * scene.camera_from_stage->Inverse(), view, depth);
    const float shutter = std::clamp(look.shutter, 0.0f, 1.0f);
    longest =
        std::min(shutter * LongestMotion(motion_blur.previous_from_pixel, people), kLongestSmear);
    if (longest >= kShortestSmear) {
      motion_blur.shutter = shutter;
      motion_blur.taps_along = TapsOver(std::hypot(longest, lens_box));
      motion_blur.tap_stretch = StretchOf(motion_blur.taps_along);
    } else {
      longest = 0.0f;
    }
  }
  if (motion_blur.taps_along * motion_blur.taps_across > 1) {
    motion_blur.reach = static_cast<int>(std::ceil(0.5f * longest + lens_box)) + 1;
  }
  return motion_blur;
}

void LookPass::MakeNoiseTile() {
  Random random(1);
  std::vector<uint8_t> texels(4 * kTile * kTile);
  for (uint8_t& texel : texels) {
    const double unit = 0.5 + 0.5 * random.Normal() / static_cast<double>(kNoiseRange);
    texel = static_cast<uint8_t>(std::clamp(std::lround(255.0 * unit), 0L, 255L));
  }
  noise_tile_ = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_2D, noise_tile_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kTile, kTile, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               texels.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
}

void LookPass::BindFor(const ShaderProgram& composite,
                       const CameraLook& look,
                       const MotionBlur& motion_blur,
                       const PixelBounds& people) {
  composite.Set("smeared_bounds", Corners(people));
  composite.Set("previous_from_pixel", motion_blur.previous_from_pixel);
  composite.Set("shutter", motion_blur.shutter);
  composite.Set("taps", glm::ivec2(motion_blur.taps_along, motion_blur.taps_across));
  composite.Set("lens_spread", motion_blur.lens_spread);
  composite.Set("lens_variance12", 12.0f * motion_blur.lens_variance);
  composite.Set("tap_stretch", motion_blur.tap_stretch);
  const bool noisy = look.noise_floor > 0.0f || look.noise_slope > 0.0f;
  composite.Set("noise_is_on", noisy ? 1 : 0);
  composite.Set("noise", glm::vec2(look.noise_floor * look.noise_floor, look.noise_slope));
  Random random(look.frame, 1);
  const uint32_t offset_y = random.Below(kTile);
  const uint32_t offset_x = random.Below(kTile);
  composite.Set("noise_offset", glm::vec2(offset_x, offset_y));
  glActiveTexture(GL_TEXTURE0 + kUnit);
  if (noisy && noise_tile_.id() == 0) {
    MakeNoiseTile();
  }
  glBindTexture(GL_TEXTURE_2D, noise_tile_.id());
  composite.Set("noise_tile", static_cast<int>(kUnit));
  glActiveTexture(GL_TEXTURE0);
}

PixelBounds Widened(const PixelBounds& bounds, int by, const ImageSize& size) {
  if (bounds.empty()) {
    return bounds;
  }
  return {std::max(bounds.left - by, 0), std::max(bounds.bottom - by, 0),
          std::min(bounds.right + by, size.width), std::min(bounds.top + by, size.height)};
}

}  // namespace lararium::render
