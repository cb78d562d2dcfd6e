#include "shared/light/probe_blend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/light/probe_weights.h"

namespace lararium::light {
namespace {

ProbeLight EvenProbe(float radiance) {
  ProbeLight light;
  light.sky[0] = glm::vec3(radiance);
  return light;
}

ProbeLight Sunny(const glm::vec3& direction, float irradiance) {
  ProbeLight light = EvenProbe(1.0f);
  light.sun = Sun{glm::normalize(direction), glm::vec3(irradiance), 0.005f};
  return light;
}

TEST(ProbeBlend, AtAProbeItIsThatProbe) {
  const PlacedProbe probes[] = {{{0, 1, 0}, 12.0, EvenProbe(1.0f)},
                                {{4, 1, 0}, 12.0, EvenProbe(3.0f)}};
  EXPECT_NEAR(Blend(probes, {0, 1, 0}, 12.0).sky[0].r, 1.0f, 1e-5f);
  EXPECT_NEAR(Blend(probes, {4, 1, 0}, 12.0).sky[0].r, 3.0f, 1e-5f);
  EXPECT_FLOAT_EQ(Blend(probes, {2, 1, 0}, 12.0).sky[0].r, 2.0f);
  // A third of the way: weights 1 and 1/4.
  EXPECT_NEAR(Blend(probes, {4.0f / 3.0f, 1, 0}, 12.0).sky[0].r, 1.4f, 1e-5f);
}

TEST(ProbeBlend, DoesNotJumpFarOrNear) {
  const PlacedProbe probes[] = {{{0, 0, 0}, 12.0, EvenProbe(1.0f)},
                                {{3, 0, 0}, 12.0, EvenProbe(3.0f)},
                                {{0, 0, 2}, 12.0, EvenProbe(5.0f)}};
  float before = Blend(probes, {-1, 0, 0}, 12.0).sky[0].r;
  for (int i = 1; i <= 600; ++i) {
    const float now = Blend(probes, {-1.0f + 0.01f * i, 0, 0}, 12.0).sky[0].r;
    EXPECT_LT(std::abs(now - before), 0.05f) << i;
    before = now;
  }
}

TEST(ProbeBlend, BetweenHoursAlsoAcrossMidnight) {
  const PlacedProbe probes[] = {{{0, 0, 0}, 10.0, EvenProbe(1.0f)},
                                {{0, 0, 0}, 14.0, EvenProbe(3.0f)},
                                {{0, 0, 0}, 22.0, EvenProbe(0.0f)}};
  EXPECT_FLOAT_EQ(Blend(probes, {5, 0, 0}, 11.0).sky[0].r, 1.5f);
  EXPECT_FLOAT_EQ(Blend(probes, {5, 0, 0}, 18.0).sky[0].r, 1.5f);
  EXPECT_FLOAT_EQ(Blend(probes, {5, 0, 0}, 4.0).sky[0].r, 0.5f);  // 6 of the 12 hours to 10
  EXPECT_FLOAT_EQ(Blend(probes, {5, 0, 0}, 14.0).sky[0].r, 3.0f);
}

TEST(ProbeBlend, TheSunTravelsAlongItsArc) {
  const PlacedProbe probes[] = {{{0, 0, 0}, 9.0, Sunny({1, 0, 0}, 2.0f)},
                                {{0, 0, 0}, 15.0, Sunny({0, 1, 0}, 4.0f)}};
  const ProbeLight noon = Blend(probes, {0, 0, 0}, 12.0);
  ASSERT_TRUE(noon.sun);
  EXPECT_LT(glm::distance(noon.sun->direction, glm::normalize(glm::vec3(1, 1, 0))), 1e-5f);
  EXPECT_FLOAT_EQ(noon.sun->irradiance.g, 3.0f);
  const ProbeLight ten = Blend(probes, {0, 0, 0}, 10.0);
  EXPECT_NEAR(std::acos(ten.sun->direction.x), 3.14159265f / 12.0f, 1e-4f);
}

TEST(ProbeBlend, ASunInOneAloneFades) {
  const ProbeLight mixed = Mix(Sunny({0, 1, 0}, 4.0f), EvenProbe(1.0f), 0.75f);
  ASSERT_TRUE(mixed.sun);
  EXPECT_FLOAT_EQ(mixed.sun->irradiance.r, 1.0f);
  EXPECT_FALSE(Mix(EvenProbe(1.0f), EvenProbe(2.0f), 0.5f).sun);
}

TEST(ProbeBlend, WeightsAddUpToOne) {
  const PlacedProbe probes[] = {
      {{0, 0, 0}, 9.0, {}}, {{0, 0, 0}, 17.0, {}}, {{4, 0, 0}, 9.0, {}}, {{4, 0, 0}, 17.0, {}}};
  float weights[4];
  ComputeProbeWeights(probes, {1, 0, 0}, 11.0, weights);
  EXPECT_FLOAT_EQ(weights[0], 0.9f * 0.75f);
  EXPECT_FLOAT_EQ(weights[1], 0.9f * 0.25f);
  EXPECT_FLOAT_EQ(weights[2], 0.1f * 0.75f);
  EXPECT_FLOAT_EQ(weights[0] + weights[1] + weights[2] + weights[3], 1.0f);
}

TEST(ProbeBlend, NoProbesNoLight) { EXPECT_EQ(Blend({}, {0, 0, 0}, 12.0).sky[0].r, 0.0f); }

}  // namespace
}  // namespace lararium::light
