#include "shared/render/sky_cones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace lararium::render {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Their cosine-weighted solid angles cover the hemisphere's, pi, in equal parts.
TEST(SkyCones, ShareTheCosineEquallyAndLookAboveTheSurface) {
  for (const glm::vec4& cone : SkyCones()) {
    EXPECT_NEAR(glm::length(glm::vec3(cone)), 1.0f, 1e-5f);
    const float cosine = glm::dot(glm::vec3(cone), SkyConeAxis());
    EXPECT_GT(cosine, 0.0f);
    EXPECT_NEAR(2.0f * kPi * (1.0f - cone.w) * cosine, kPi / kSkyConeCount, 1e-4f);
  }
}

// The mean of a linear function over equal shares of the cosine is 2/3 of the normal's.
TEST(SkyCones, AverageToTwoThirdsOfTheNormal) {
  glm::vec3 mean(0.0f);
  for (const glm::vec4& cone : SkyCones()) {
    mean += glm::vec3(cone) / static_cast<float>(kSkyConeCount);
  }
  EXPECT_LT(glm::distance(mean, 2.0f / 3.0f * SkyConeAxis()), 0.04f);
}

TEST(SkyMap, HoldsRadianceByDirection) {
  light::ShRgb light = {};
  light[0] = glm::vec3(2.0f, 1.0f, 0.0f);
  light[1] = glm::vec3(0.5f);  // y
  std::vector<glm::vec4> map;
  FillSkyMap(light, map);
  const auto at = [&](int column, int row) {
    return map[static_cast<size_t>(row * kSkyMapSize + column)];
  };
  const float even = 2.0f * std::sqrt(0.25f / kPi);
  const float slope = 0.5f * std::sqrt(0.75f / kPi);
  // The middle looks up, corners down; a cone's mean is a little less than its middle.
  EXPECT_NEAR(at(kSkyMapSize / 2, kSkyMapSize / 2).x, even + slope, 0.05f * slope);
  EXPECT_NEAR(at(0, 0).x, even - slope, 0.05f * slope);
  EXPECT_GT(at(kSkyMapSize / 2, kSkyMapSize / 2).x, at(kSkyMapSize / 2, 0).x);
  for (const glm::vec4& texel : map) {
    EXPECT_GE(texel.z, 0.0f);
  }
}

}  // namespace
}  // namespace lararium::render
