#include "shared/render/quality.h"

#include <algorithm>
#include <array>

namespace lararium::render {
namespace {

constexpr Quality AtHalfRate(Quality quality) {
  quality.half_rate = true;
  return quality;
}

}  // namespace

Quality Clamped(const Quality& quality) {
  Quality clamped = quality;
  clamped.samples = std::max(quality.samples, 1);
  // This order of min and max turns NaN into the minimum.
  clamped.layer_scale = std::min(std::max(0.25f, quality.layer_scale), 1.0f);
  clamped.shadow_cell = std::clamp(quality.shadow_cell, 4, 16);
  clamped.sun_map = quality.sun_map < 1024 ? 512 : 1024;
  clamped.sun_taps = std::clamp(quality.sun_taps, 4, 14);
  clamped.detail_px = std::max(0.1f, quality.detail_px);
  clamped.triangles = std::max(quality.triangles, 1000);
  clamped.texture_halvings = std::clamp(quality.texture_halvings, 0, 3);
  return clamped;
}

std::span<const Quality> QualityLadder() {
  static constexpr Quality kSmall = {.samples = 1,
                                     .full_size = false,
                                     .layer_scale = 0.5f,
                                     .shadow_cell = 16,
                                     .sun_map = 512,
                                     .sun_taps = 4,
                                     .reflections = false,
                                     .camera_look = false,
                                     .detail_px = 2.0f,
                                     .triangles = 80'000,
                                     .texture_halvings = 2};
  static constexpr std::array<Quality, 6> kLadder = {{
      {},
      {.samples = 1, .sun_taps = 8, .detail_px = 0.75f},
      {.samples = 1,
       .full_size = false,
       .shadow_cell = 8,
       .sun_map = 512,
       .sun_taps = 6,
       .detail_px = 1.0f},
      {.samples = 1,
       .full_size = false,
       .layer_scale = 0.7f,
       .shadow_cell = 8,
       .sun_map = 512,
       .sun_taps = 4,
       .reflections = false,
       .detail_px = 2.0f,
       .triangles = 100'000,
       .texture_halvings = 1},
      kSmall,
      AtHalfRate(kSmall),
  }};
  return kLadder;
}

}  // namespace lararium::render
