#include "shared/render/look_pass.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "shared/core/random.h"

namespace lararium::render {
namespace {

constexpr int kTile = 256;  // texels along a side of the noise
constexpr float kNoiseRange = 4.0f;
constexpr float kLongestSmear = 24.0f;  // pixels
constexpr float kWidestLens = 4.0f;
// Shorter motions than this, in pixels, change no edge that anybody could see.
constexpr float kShortestSmear = 0.7f;
constexpr float kTapGap = 1.5f;  // pixels; taps are bilinear
constexpr int kMostTaps = 16;
// Of linear interpolation, on average over where between two pixels it is.
constexpr float kEnlargedVariance = 1.0f / 6.0f;

// The longest way that a point of the bounds has gone, for an open shutter; at a corner,
// since the map is nearly affine.
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

// n even taps over a length have its variance (a box's) less this share.
float StretchOf(int taps) {
  return 1.0f / std::sqrt(1.0f - 1.0f / static_cast<float>(taps * taps));
}

}  // namespace

Smear SmearOf(const RenderScene& scene,
              const PictureView& view,
              const PixelBounds& people,
              float depth) {
  const CameraLook& look = scene.look;
  Smear smear;
  const float scale = static_cast<float>(view.size.width) / static_cast<float>(view.most.width);
  const float in_picture = std::clamp(look.blur_px, 0.0f, kWidestLens);
  // A smaller layer is softened by being enlarged.
  const float enlarged = scale < 1.0f ? kEnlargedVariance : 0.0f;
  smear.lens_variance = std::max(scale * scale * in_picture * in_picture - enlarged, 0.0f);
  const float lens_box = std::sqrt(12.0f * smear.lens_variance);
  if (smear.lens_variance > 1e-4f && smear.lens_variance <= 1.0f) {
    // Two bilinear taps at +-d of texel centres have the variance d, for d up to 1.
    smear.taps_across = 2;
    smear.lens_spread = 4.0f * smear.lens_variance;
  } else if (smear.lens_variance > 1.0f) {
    smear.taps_across = TapsOver(lens_box);
    smear.lens_spread = lens_box * StretchOf(smear.taps_across);
  }
  smear.taps_along = smear.taps_across;
  float longest = 0.0f;
  if (look.previous_camera_from_stage && look.shutter > 0.0f && !people.empty()) {
    smear.previous_from_pixel = PreviousFromPixel(scene, view, depth);
    const float shutter = std::clamp(look.shutter, 0.0f, 1.0f);
    longest = std::min(shutter * LongestMotion(smear.previous_from_pixel, people), kLongestSmear);
    if (longest >= kShortestSmear) {
      smear.shutter = shutter;
      smear.taps_along = TapsOver(std::hypot(longest, lens_box));
      smear.tap_stretch = StretchOf(smear.taps_along);
    } else {
      longest = 0.0f;
    }
  }
  if (smear.taps_along * smear.taps_across > 1) {
    smear.reach = static_cast<int>(std::ceil(0.5f * longest + lens_box)) + 1;
  }
  return smear;
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
                       const Smear& smear,
                       const PixelBounds& people) {
  composite.Set("smeared_bounds", Corners(people));
  composite.Set("previous_from_pixel", smear.previous_from_pixel);
  composite.Set("shutter", smear.shutter);
  composite.Set("taps", glm::ivec2(smear.taps_along, smear.taps_across));
  composite.Set("lens_spread", smear.lens_spread);
  composite.Set("lens_variance12", 12.0f * smear.lens_variance);
  composite.Set("tap_stretch", smear.tap_stretch);
  const bool noisy = look.noise_floor > 0.0f || look.noise_slope > 0.0f;
  composite.Set("noise_is_on", noisy ? 1 : 0);
  composite.Set("noise", glm::vec2(look.noise_floor * look.noise_floor, look.noise_slope));
  Random random(look.frame, 1);
  composite.Set("noise_offset", glm::vec2(random.Below(kTile), random.Below(kTile)));
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
