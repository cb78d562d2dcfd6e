#include "editor/import/wardrobe/weave.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "shared/core/random.h"
#include "shared/image/encode.h"

namespace lararium::import {
namespace {

constexpr int kSize = 512;

// Properties of a kind of weave. `threads` counts across the width of the image.
struct WeaveLook {
  int threads = 128;
  float relief = 0.5f;  // Relief of a thread, 0..1.
  float slubs = 0.1f;   // Variation of shade between threads.
  float fuzz = 0.05f;   // Strength of the grain.
  bool twill = false;   // Over two threads, under one.
};

WeaveLook LookOf(Weave weave) {
  switch (weave) {
    case Weave::kWool:
      return {.threads = 128, .relief = 0.45f, .slubs = 0.10f, .fuzz = 0.10f, .twill = true};
    case Weave::kLinen:
      return {.threads = 170, .relief = 0.5f, .slubs = 0.14f, .fuzz = 0.04f, .twill = false};
    case Weave::kLeather:
      return {.threads = 0, .relief = 0.0f, .slubs = 0.0f, .fuzz = 0.16f, .twill = false};
  }
  return {};
}

// Periodic smooth noise, -1..1, with this number of features across the image.
cv::Mat1f TileNoise(int cells_x, int cells_y, Random& random) {
  cv::Mat1f lattice(cells_y, cells_x);
  for (float& value : lattice) {
    value = static_cast<float>(random.Uniform(-1.0, 1.0));
  }
  cv::Mat1f wrapped;
  cv::copyMakeBorder(lattice, wrapped, 2, 2, 2, 2, cv::BORDER_WRAP);
  cv::Mat1f noise(kSize, kSize);
  cv::Mat1f map_x(kSize, kSize);
  cv::Mat1f map_y(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      map_x(y, x) = 2.0f + static_cast<float>(x) * static_cast<float>(cells_x) / kSize;
      map_y(y, x) = 2.0f + static_cast<float>(y) * static_cast<float>(cells_y) / kSize;
    }
  }
  cv::remap(wrapped, noise, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_WRAP);
  return noise;
}

// Height of the cloth, 0..1.
cv::Mat1f Relief(const WeaveLook& look, Random& random) {
  cv::Mat1f height(kSize, kSize, 0.5f);
  const cv::Mat1f grain = TileNoise(kSize / 2, kSize / 2, random);
  const cv::Mat1f wander_x = TileNoise(6, 24, random);
  const cv::Mat1f wander_y = TileNoise(24, 6, random);
  for (int y = 0; y < kSize && look.threads > 0; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const float u =
          static_cast<float>(x) * static_cast<float>(look.threads) / kSize + 0.35f * wander_x(y, x);
      const float v =
          static_cast<float>(y) * static_cast<float>(look.threads) / kSize + 0.35f * wander_y(y, x);
      const int warp = static_cast<int>(std::floor(u));
      const int weft = static_cast<int>(std::floor(v));
      const float across_warp = std::sin(3.14159265f * (u - std::floor(u)));
      const float across_weft = std::sin(3.14159265f * (v - std::floor(v)));
      const bool warp_on_top = look.twill ? (warp + weft) % 4 < 2 : (warp + weft) % 2 == 0;
      const float top = warp_on_top ? across_warp : across_weft;
      const float below = warp_on_top ? across_weft : across_warp;
      height(y, x) = 0.25f + 0.6f * top + 0.15f * below;
    }
  }
  return (1.0f - look.fuzz) * height + look.fuzz * (0.5f + 0.5f * grain);
}

Result<human::Texture> Encoded(const char* name, const cv::Mat& image) {
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> jpeg, image::EncodeJpeg(image, 88));
  return human::Texture{name, std::move(jpeg)};
}

}  // namespace

Result<human::Texture> WeaveColour(Weave weave, uint64_t seed) {
  const WeaveLook look = LookOf(weave);
  Random random(seed, 1);
  const cv::Mat1f height = Relief(look, random);
  const cv::Mat1f warp_shade = TileNoise(std::max(2, look.threads), 8, random);
  const cv::Mat1f weft_shade = TileNoise(8, std::max(2, look.threads), random);
  const cv::Mat1f cloud = TileNoise(5, 5, random);
  const cv::Mat1f grain = TileNoise(kSize / 3, kSize / 3, random);
  cv::Mat3b image(kSize, kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const float shade = 0.93f + look.relief * 0.22f * (height(y, x) - 0.75f) +
                          0.5f * look.slubs * (warp_shade(y, x) + weft_shade(y, x)) * 0.5f +
                          0.02f * cloud(y, x) + 0.25f * look.fuzz * grain(y, x);
      const float warmth = 0.012f * cloud(y, x);
      for (int k = 0; k < 3; ++k) {  // Blue, green, red.
        const float value = shade + warmth * static_cast<float>(k - 1);
        image(y, x)[k] = cv::saturate_cast<uchar>(255.0f * value);
      }
    }
  }
  return Encoded("weave", image);
}

Result<human::Texture> WeaveNormals(Weave weave, uint64_t seed) {
  Random random(seed, 1);
  const cv::Mat1f height = Relief(LookOf(weave), random);
  cv::Mat3b image(kSize, kSize);
  constexpr float kSteepness = 0.55f;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const auto at = [&](int dx, int dy) {
        return height((y + dy + kSize) % kSize, (x + dx + kSize) % kSize);
      };
      const float slope_x = kSteepness * (at(1, 0) - at(-1, 0));
      const float slope_y = kSteepness * (at(0, 1) - at(0, -1));
      const float length = std::sqrt(1.0f + slope_x * slope_x + slope_y * slope_y);
      // Green points up in the image.
      const float normal[3] = {-slope_x / length, slope_y / length, 1.0f / length};
      for (int k = 0; k < 3; ++k) {
        image(y, x)[2 - k] = cv::saturate_cast<uchar>(127.5f * (normal[k] + 1.0f));
      }
    }
  }
  return Encoded("weave normals", image);
}

}  // namespace lararium::import
