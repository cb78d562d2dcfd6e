#include "editor/import/objects/grain.h"

#include <cmath>
#include <glm/common.hpp>
#include <opencv2/core.hpp>

#include "editor/import/objects/paint.h"
#include "shared/core/check.h"
#include "shared/core/units.h"
#include "shared/image/encode.h"

namespace lararium::import {
namespace {
constexpr int kSize = 256;
constexpr float kWoodLength = 1.0f;  // Length of the image, metres.
constexpr float kWoodWidth = 0.25f;
constexpr float kRod = 0.012f;  // Distance between rods, metres.
constexpr int kRodsInPicture = 4;
constexpr int kStakes = 32;  // Around the basket.
constexpr int kStakesInPicture = 4;

// Noise with period 1 in u and v, sampled on a torus in the space of the noise.
float TilingNoise(float u, float v, const glm::vec2& radii, uint32_t seed) {
  const float a = 2.0f * kPiF * u;
  const float b = 2.0f * kPiF * v;
  // Two circles need four dimensions, so two three-dimensional noises are combined.
  const glm::vec3 first(radii.x * std::cos(a), radii.x * std::sin(a), radii.y * std::cos(b));
  const glm::vec3 second(radii.x * std::cos(a), radii.x * std::sin(a),
                         radii.y * std::sin(b) + 31.7f);
  return 0.5f * (FractalNoise(first, seed) + FractalNoise(second, seed + 19));
}

template <typename Shade>
human::Texture Picture(const char* name, Shade shade) {
  cv::Mat image(kSize, kSize, CV_8UC3);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      const float u = (static_cast<float>(column) + 0.5f) / kSize;
      const float v = (static_cast<float>(row) + 0.5f) / kSize;
      const glm::vec3 rgb = glm::clamp(shade(u, v), 0.0f, 1.0f);
      // Approximates sRGB, which is sufficient for an invented texture.
      const auto byte = [](float value) {
        return static_cast<uint8_t>(std::lround(255.0f * std::pow(value, 1.0f / 2.2f)));
      };
      image.at<cv::Vec3b>(row, column) = {byte(rgb.z), byte(rgb.y), byte(rgb.x)};
    }
  }
  auto jpeg = image::EncodeJpeg(image, 88);
  CHECK(jpeg.ok());
  return {name, std::move(*jpeg)};
}

glm::vec3 Wood(float u, float v) {
  // Annual rings cut lengthwise: bands that waver along the grain, with pores.
  const float waver = TilingNoise(u, v, {0.35f, 1.2f}, 401);
  const float rings = 0.5f + 0.5f * std::sin(2.0f * kPiF * (7.0f * v + 2.2f * waver));
  const float pores = TilingNoise(u, v, {1.6f, 26.0f}, 433);
  const float value = 0.86f - 0.28f * rings * rings + 0.55f * glm::min(pores, 0.0f);
  return value * glm::mix(glm::vec3(1.0f), glm::vec3(1.0f, 0.94f, 0.86f), rings);
}

glm::vec3 Wicker(float u, float v) {
  const float row = std::floor(v * kRodsInPicture);
  const float in_rod = v * kRodsInPicture - row;
  const float side = std::fmod(row, 2.0f) * kPiF;
  // 1 where the rod is in front of a stake, -1 where it is behind one.
  const float over = std::cos(kPiF * kStakesInPicture * u + side);
  const float roundness = std::sqrt(std::max(0.0f, 1.0f - std::pow(2.0f * in_rod - 1.0f, 2.0f)));
  const float fibre = TilingNoise(u, v, {2.0f, 20.0f}, 457);
  return glm::vec3(0.18f + roundness * (0.55f + 0.22f * over) + 0.25f * fibre);
}

}  // namespace

human::Texture WoodGrain() { return Picture("wood", Wood); }

human::Texture WickerWeave() { return Picture("wicker", Wicker); }

void PanelWithWood(int grain_axis, stage::PropMesh& mesh) {
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& p = mesh.positions[i];
    // On the face of a board one of the two other coordinates is constant.
    const float across = p[(grain_axis + 1) % 3] + p[(grain_axis + 2) % 3];
    mesh.uvs[i] = {p[grain_axis] / kWoodLength, across / kWoodWidth};
  }
}

void WeaveOfWicker(stage::PropMesh& mesh) {
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.uvs[i].x *= static_cast<float>(kStakes) / kStakesInPicture;
    mesh.uvs[i].y = mesh.positions[i].y / (kRod * kRodsInPicture);
  }
}

}  // namespace lararium::import
