#include "editor/bake/sun_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/random.h"
#include "tests/bake/probe_images.h"

namespace lararium::bake {
namespace {

using test::DiscOn;
using test::Irradiance;
using test::MakeProbe;

glm::vec3 EvenSky(const glm::vec3& d) { return {0.4f + 0.2f * d.y, 0.5f + 0.2f * d.y, 0.8f}; }

glm::vec3 SunDirection(Random& random) {
  return glm::normalize(glm::vec3{random.Normal(), random.Normal(), random.Normal()});
}

TEST(SunSplit, FindsWhereHowLargeAndHowBrightADiscIs) {
  Random random(11);
  for (const float radius : {0.02f, 0.05f}) {
    for (int i = 0; i < 4; ++i) {
      const light::Sun sun{SunDirection(random), {5.0f, 4.0f, 3.0f}, radius};
      const ProbeImage image = MakeProbe(512, DiscOn(EvenSky, sun));
      const SplitProbe split = SplitSun(image);
      ASSERT_TRUE(split.sun) << "seed 11, sun " << i;
      EXPECT_LT(glm::distance(split.sun->direction, sun.direction), 0.004f) << "seed 11, " << i;
      EXPECT_LT(glm::distance(split.sun->irradiance, sun.irradiance), 0.15f) << "seed 11, " << i;
      EXPECT_NEAR(split.sun->angular_radius, radius, 0.12f * radius + 0.002f) << "seed 11, " << i;
    }
  }
}

TEST(SunSplit, SkyAndSunTogetherAreTheWholeImage) {
  Random random(12);
  for (int i = 0; i < 3; ++i) {
    const light::Sun sun{SunDirection(random), {9.0f, 8.0f, 6.0f}, 0.02f};
    const ProbeImage image = MakeProbe(512, DiscOn(EvenSky, sun));
    const SplitProbe split = SplitSun(image);
    ASSERT_TRUE(split.sun);
    for (int k = 0; k < 10; ++k) {
      const glm::vec3 normal = SunDirection(random);
      const glm::dvec3 whole = Irradiance(image, normal);
      const glm::dvec3 parts = Irradiance(split.sky, normal) +
                               std::max(0.0, double{glm::dot(normal, split.sun->direction)}) *
                                   glm::dvec3(split.sun->irradiance);
      EXPECT_LT(glm::distance(parts, whole), 0.01 * glm::length(whole)) << "seed 12, " << i;
    }
    const light::ShRgb expected =
        light::ProjectEquirectangular(image.pixels, image.width, image.height);
    const light::ShRgb actual = ProjectProbeLight(image, {}).Whole();
    for (int k = 0; k < light::kShCount; ++k) {
      EXPECT_LT(glm::distance(actual[k], expected[k]), 0.01f * glm::length(expected[0])) << k;
    }
  }
}

// The lowest radiance of the harmonics relative to the mean.
float Undershoot(const light::ShRgb& light) {
  Random random(1);
  float least = 1.0f;
  const float mean = light[0].g * light::EvaluateShBasis({0, 1, 0})[0];
  for (int i = 0; i < 2000; ++i) {
    least = std::min(least, light::EvaluateRadiance(light, SunDirection(random)).g / mean);
  }
  return least;
}

TEST(SunSplit, WhatIsLeftDoesNotRing) {
  const light::Sun sun{glm::normalize(glm::vec3(1, 1, 0)), glm::vec3(6.0f), 0.01f};
  const ProbeImage image = MakeProbe(512, DiscOn(EvenSky, sun));
  EXPECT_LT(Undershoot(light::ProjectEquirectangular(image.pixels, image.width, image.height)),
            -0.1f);
  EXPECT_GT(Undershoot(ProjectProbeLight(image, {}).sky), 0.4f);
}

TEST(SunSplit, AnEvenSkyAWideWindowAndAWeakLampAreNoSuns) {
  EXPECT_FALSE(SplitSun(MakeProbe(256, EvenSky)).sun);
  // The source is 40 degrees wide.
  EXPECT_FALSE(SplitSun(MakeProbe(256, DiscOn(EvenSky, {{0, 0, -1}, glm::vec3(4.0f), 0.35f}))).sun);
  // The source gives 4 % of the irradiance of a surface that faces it.
  const SplitProbe lamp =
      SplitSun(MakeProbe(512, DiscOn(EvenSky, {{0, 0, -1}, glm::vec3(0.06f), 0.02f})));
  EXPECT_FALSE(lamp.sun);
  EXPECT_NEAR(lamp.share, 0.04, 0.01);
}

TEST(SunSplit, WorksAcrossTheSeamAndAtThePoles) {
  for (const glm::vec3& direction :
       {glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), glm::normalize(glm::vec3(0.01f, -1, 0.01f))}) {
    const ProbeImage image = MakeProbe(512, DiscOn(EvenSky, {direction, glm::vec3(5.0f), 0.03f}));
    const SplitProbe split = SplitSun(image);
    ASSERT_TRUE(split.sun);
    const double disc =
        Irradiance(image, direction).g - Irradiance(MakeProbe(512, EvenSky), direction).g;
    EXPECT_LT(glm::distance(split.sun->direction, direction), 0.005f);
    EXPECT_NEAR(split.sun->irradiance.g, disc, 0.01 * disc);
  }
}

TEST(SunSplit, SmallImagesDoNotFail) {
  for (const int width : {8, 16, 34}) {
    const ProbeImage image = MakeProbe(
        width, [](const glm::vec3& d) { return d.y > 0.9f ? glm::vec3(100.0f) : glm::vec3(0.1f); });
    const SplitProbe split = SplitSun(image);
    EXPECT_TRUE(std::isfinite(split.share));
    EXPECT_TRUE(std::isfinite(split.brightest.irradiance.r));
  }
}

}  // namespace
}  // namespace lararium::bake
