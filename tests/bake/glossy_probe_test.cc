#include "editor/bake/glossy_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/units.h"
#include "shared/light/octahedral.h"

namespace lararium::bake {
namespace {
using light::GlossyMap;

ProbeImage Even(int width, const glm::vec3& radiance) {
  ProbeImage image;
  image.width = width;
  image.height = width / 2;
  image.pixels.assign(static_cast<size_t>(width) * static_cast<size_t>(width) / 2, radiance);
  return image;
}

glm::vec3 TexelOf(const GlossyMap& map, int layer, int column, int row) {
  return light::UnpackRadiance(map.texels[static_cast<size_t>(
      (layer * GlossyMap::kSize + row) * GlossyMap::kSize + column)]);
}

TEST(GlossyProbe, EvenLightStaysEven) {
  const GlossyMap map = PrefilterProbe(Even(64, {0.5f, 1.0f, 2.0f}), {});
  for (const uint32_t texel : map.texels) {
    EXPECT_LT(glm::distance(light::UnpackRadiance(texel), glm::vec3(0.5f, 1.0f, 2.0f)), 0.03f);
  }
}

TEST(GlossyProbe, APointOfLightBecomesTheLobe) {
  ProbeImage image = Even(128, glm::vec3(0.0f));
  constexpr int kColumn = 80, kRow = 24;
  image.pixels[kRow * 128 + kColumn] = glm::vec3(1000.0f);
  const double azimuth = 2.0 * kPi * ((kColumn + 0.5) / 128 - 0.5);
  const double elevation = kPi * (0.5 - (kRow + 0.5) / 64);
  const glm::vec3 light(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                        -std::cos(elevation) * std::cos(azimuth));
  const double power =
      1000.0 * 2.0 * kPi / 128 * (std::cos(kPi * kRow / 64) - std::cos(kPi * (kRow + 1) / 64));
  const GlossyMap map = PrefilterProbe(image, {});
  for (const int layer : {2, 3, 5}) {
    const double roughness = light::RoughnessOfLayer(layer);
    double whole = 0.0;  // Integral of the lobe by the midpoint rule.
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
      whole += 2.0 * kPi / kSteps * light::GlossyWeight((i + 0.5) / kSteps, roughness);
    }
    const double top = power / whole;
    for (int row = 0; row < GlossyMap::kSize; row += 3) {
      for (int column = 0; column < GlossyMap::kSize; column += 3) {
        const double cosine = glm::dot(light::GlossyDirection(column, row), light);
        const double expected = top * light::GlossyWeight(cosine, roughness);
        EXPECT_NEAR(TexelOf(map, layer, column, row).g, expected, 0.05 * top)
            << "layer " << layer << ", texel " << column << " " << row;
      }
    }
  }
}

TEST(GlossyProbe, TurnsAndBrightensWithThePlacement) {
  ProbeImage image = Even(64, glm::vec3(0.1f));
  for (int row = 12; row < 20; ++row) {
    for (int column = 44; column < 52; ++column) {  // About +X.
      image.pixels[static_cast<size_t>(row * 64 + column)] = glm::vec3(5.0f);
    }
  }
  const glm::quat turn = glm::angleAxis(0.5f * static_cast<float>(kPi), glm::vec3(0, 1, 0));
  const GlossyMap plain = PrefilterProbe(image, {});
  const GlossyMap turned = PrefilterProbe(image, {turn, 2.0f});
  const auto at = [](const GlossyMap& map, const glm::vec3& direction) {
    const glm::vec2 texel = (0.5f * light::OctahedralPosition(direction) + 0.5f) *
                            static_cast<float>(GlossyMap::kSize - 1);
    return TexelOf(map, 3, static_cast<int>(std::lround(texel.x)),
                   static_cast<int>(std::lround(texel.y)))
        .r;
  };
  EXPECT_NEAR(at(turned, {0, 0, -1}) / at(plain, {1, 0, 0}), 2.0f, 0.2f);
  EXPECT_LT(at(turned, {1, 0, 0}), 0.5f * at(turned, {0, 0, -1}));
}

}  // namespace
}  // namespace lararium::bake
