#include "shared/render/passes/sky_cones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/units.h"

namespace lararium::render {
namespace {

// The cosine-weighted solid angles of the cones are equal, and their sum is pi, that of the
// hemisphere.
TEST(SkyCones, ShareTheCosineEquallyAndLookAboveTheSurface) {
  for (const glm::vec4& cone : SkyCones()) {
    EXPECT_NEAR(glm::length(glm::vec3(cone)), 1.0f, 1e-5f);
    const float cosine = glm::dot(glm::vec3(cone), SkyConeAxis());
    EXPECT_GT(cosine, 0.0f);
    EXPECT_NEAR(2.0f * kPiF * (1.0f - cone.w) * cosine, kPiF / kSkyConeCount, 1e-4f);
  }
}

// The mean of a linear function over the cosine-weighted hemisphere is 2/3 of its value at the
// normal.
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
  const float even = 2.0f * std::sqrt(0.25f / kPiF);
  const float slope = 0.5f * std::sqrt(0.75f / kPiF);
  // The middle of the map is up and its corners are down. The mean over a cone is slightly less
  // than the value at its axis.
  EXPECT_NEAR(at(kSkyMapSize / 2, kSkyMapSize / 2).x, even + slope, 0.05f * slope);
  EXPECT_NEAR(at(0, 0).x, even - slope, 0.05f * slope);
  EXPECT_GT(at(kSkyMapSize / 2, kSkyMapSize / 2).x, at(kSkyMapSize / 2, 0).x);
  for (const glm::vec4& texel : map) {
    EXPECT_GE(texel.z, 0.0f);
  }
}

}  // namespace
}  // namespace lararium::render
