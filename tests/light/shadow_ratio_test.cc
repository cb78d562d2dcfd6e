#include "shared/light/shadow_ratio.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "shared/core/units.h"
#include "tests/light/sh_test_support.h"

namespace lararium::light {
namespace {
const glm::vec3 kUp(0.0f, 1.0f, 0.0f);

struct Ratios {
  std::vector<float> r, g, b;
  explicit Ratios(size_t size) : r(size), g(size), b(size) {}
  RgbSpans spans() { return {r, g, b}; }
};

ShRgb EvenSky() {
  ShRgb light = {};
  light[0] = glm::vec3(1.0f, 2.0f, 3.0f);
  return light;
}

class ShadowRatioOf : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Counts, ShadowRatioOf, testing::Values(9, 16, 25));

// A ball above a floor under a uniform sky hides sin^2(a) cos(t), where a is its angular radius and
// t is the angle from the normal to its centre, if it is completely above the horizon (Howell, "A
// Catalog of Radiation Heat Transfer Configuration Factors", B-43).
TEST_P(ShadowRatioOf, OfABallAboveAFloorIsTheFormFactor) {
  std::vector<glm::vec3> points;
  std::vector<double> expected;
  const Ball ball = {{0.0f, 0.6f, 0.0f}, 0.3f};
  for (int i = 0; i <= 20; ++i) {
    points.emplace_back(0.1f * static_cast<float>(i), 0.0f, 0.0f);
    const glm::vec3 d = ball.centre - points.back();
    const double sine = ball.radius / glm::length(d);
    expected.push_back(1.0 - sine * sine * glm::normalize(d).y);
  }
  const PointArrays at(points);
  ShRows log(GetParam(), points.size());
  AddLogVisibility(BallArrays({ball}).spheres(), at.points(), {0, points.size()}, log);
  Ratios ratios(points.size());
  ShadowRatio(CosineLight(EvenSky(), kUp), log, {0, points.size()}, ratios.spans());
  double squared = 0.0;
  for (size_t i = 0; i < points.size(); ++i) {
    squared += std::pow(ratios.g[i] - expected[i], 2) / static_cast<double>(points.size());
    EXPECT_NEAR(ratios.g[i], expected[i], 0.02) << "at " << points[i].x;
    EXPECT_NEAR(ratios.r[i], ratios.b[i], 1e-5);
  }
  std::printf("  %d coefficients: rms %.4f of the analytic ratio\n", GetParam(),
              std::sqrt(squared));
}

// Band-limited positive light, compared with sums over many directions.
TEST_P(ShadowRatioOf, InColouredLightEqualsQuadrature) {
  Random random(71);
  ShRgb light = {};
  for (size_t k = 0; k < 16; ++k) {
    light[k] = 0.12f * glm::vec3(random.Normal(), random.Normal(), random.Normal());
  }
  light[0] = glm::vec3(3.0f, 2.5f, 2.0f);
  const glm::vec3 normal = glm::normalize(glm::vec3(0.2f, 1.0f, -0.3f));
  const std::vector<Ball> balls = {
      {{0.3f, 0.9f, 0.1f}, 0.3f}, {{-0.4f, 1.2f, 0.3f}, 0.35f}, {{0.1f, 0.8f, -0.9f}, 0.25f}};
  glm::dvec3 shadowed(0.0), unshadowed(0.0);
  for (const glm::vec3& d : EvenDirections(20000)) {
    const glm::dvec3 falls(std::max(0.0f, glm::dot(d, normal)) * EvaluateRadiance(light, d));
    bool visible = true;
    for (const Ball& ball : balls) {
      const float along = glm::dot(ball.centre, d);
      visible = visible && !(along > 0.0f && glm::dot(ball.centre, ball.centre) - along * along <
                                                 ball.radius * ball.radius);
    }
    unshadowed += falls;
    shadowed += visible ? falls : glm::dvec3(0.0);
  }
  ShRows log(GetParam(), 1);
  AddLogVisibility(BallArrays(balls).spheres(), PointArrays({glm::vec3(0.0f)}).points(), {0, 1},
                   log);
  Ratios ratios(1);
  const ShRgb cosine_light = CosineLight(light, normal);
  ShadowRatio(cosine_light, log, {0, 1}, ratios.spans());
  const glm::dvec3 expected = shadowed / unshadowed;
  EXPECT_LT(expected.g, 0.85);
  EXPECT_NEAR(ratios.r[0], expected.r, 0.02);
  EXPECT_NEAR(ratios.g[0], expected.g, 0.02);
  EXPECT_NEAR(ratios.b[0], expected.b, 0.02);

  ShRowsRgb own = {ShRows(GetParam(), 1), ShRows(GetParam(), 1), ShRows(GetParam(), 1)};
  for (int channel = 0; channel < 3; ++channel) {
    for (int k = 0; k < GetParam(); ++k) {
      own[static_cast<size_t>(channel)].at(k, 0) = cosine_light[static_cast<size_t>(k)][channel];
    }
  }
  Ratios same(1);
  ShadowRatio(own, log, {0, 1}, same.spans());
  EXPECT_EQ(same.g[0], ratios.g[0]);
}

TEST(CosineLight, FirstCoefficientIsTheIrradiance) {
  Random random(72);
  ShRgb light = RandomCoefficients(random);
  light[0] = glm::vec3(30.0f);
  for (int i = 0; i < 10; ++i) {
    const glm::vec3 normal = RandomDirection(random);
    const glm::vec3 irradiance = EvaluateIrradiance(light, normal);
    const ShRgb cosine_light = CosineLight(light, normal);
    for (int channel = 0; channel < 3; ++channel) {
      EXPECT_NEAR(cosine_light[0][channel] * std::sqrt(4.0 * kPi), irradiance[channel],
                  1e-5 * irradiance[channel]);
    }
  }
}

TEST(ShadowRatio, IsOneWithoutBallsAndWithoutLight) {
  ShRows log(16, 3);
  Ratios ratios(3);
  ShadowRatio(CosineLight(EvenSky(), kUp), log, {0, 3}, ratios.spans());
  EXPECT_NEAR(ratios.r[2], 1.0, 1e-5);
  ShadowRatio(ShRgb{}, log, {0, 3}, ratios.spans());
  EXPECT_EQ(ratios.r[1], 1.0f);
}

}  // namespace
}  // namespace lararium::light
