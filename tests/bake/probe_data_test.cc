#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "editor/bake/probe.h"
#include "editor/bake/sun_split.h"
#include "shared/core/units.h"
#include "tests/support/test_files.h"

namespace lararium::bake {
namespace {

// Irradiance as a sum of cosine-weighted texels, with the directions from the notes of the data
// set, converted from its Z-up world to stage axes (x, z, -y).
glm::dvec3 SumIrradiance(const ProbeImage& image, const glm::vec3& normal) {
  glm::dvec3 sum(0.0);
  for (int row = 0; row < image.height; ++row) {
    const double elevation = kPi * (0.5 - (row + 0.5) / image.height);
    const double solid_angle =
        std::cos(elevation) * (kPi / image.height) * (2.0 * kPi / image.width);
    for (int column = 0; column < image.width; ++column) {
      const double azimuth = 2.0 * kPi * ((column + 0.5) / image.width - 0.5);
      const glm::dvec3 world(std::cos(elevation) * std::sin(azimuth),
                             std::cos(elevation) * std::cos(azimuth), std::sin(elevation));
      const glm::dvec3 stage(world.x, world.z, -world.y);
      const double cosine = std::max(0.0, glm::dot(stage, glm::dvec3(normal)));
      sum += solid_angle * cosine * glm::dvec3(image.pixels[row * image.width + column]);
    }
  }
  return sum;
}

TEST(MaquetteProbe, TheCoefficientsComeCloseToTheIntegral) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  const auto image = ReadProbeImage(folder / "probe.exr");
  ASSERT_TRUE(image.ok()) << image.message();
  const light::ShRgb light = ProjectProbeLight(*image, {}).Whole();
  // The sun has an irradiance of 5.9, so the error of degree 5 may reach 6 % of its share at
  // single normals; the average is about 1 %.
  double squared_error = 0.0, squared = 0.0;
  int count = 0;
  for (int i = 0; i < 100; ++i) {
    const double y = 1.0 - 2.0 * (i + 0.5) / 100.0;  // a spiral over the sphere
    const double angle = 2.399963 * i;
    const double radius = std::sqrt(1.0 - y * y);
    const glm::vec3 normal(radius * std::cos(angle), y, radius * std::sin(angle));
    const glm::dvec3 expected = SumIrradiance(*image, normal);
    const glm::dvec3 actual(light::EvaluateIrradiance(light, normal));
    const glm::dvec3 difference = actual - expected;
    EXPECT_LT(std::abs(difference.r), 0.06 * 5.92 + 0.02 * expected.r);
    squared_error += glm::dot(difference, difference);
    squared += glm::dot(expected, expected);
    ++count;
  }
  EXPECT_LT(std::sqrt(squared_error / squared), 0.025);
}

TEST(MaquetteProbe, TheSunStandsWhereItsNotesSay) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  const auto image = ReadProbeImage(folder / "probe.exr");
  ASSERT_TRUE(image.ok()) << image.message();
  const light::ShRgb light = ProjectProbeLight(*image, {}).Whole();
  // Towards the sun: world (-0.502, -0.622, 0.602), stage (-0.502, 0.602, 0.622).
  const glm::vec3 sun(-0.502f, 0.602f, 0.622f);
  EXPECT_GT(light::EvaluateIrradiance(light, sun).r, 5.92f);
  EXPECT_GT(light::EvaluateIrradiance(light, sun).r,
            3.0f * light::EvaluateIrradiance(light, {-sun.x, sun.y, -sun.z}).r);
}

TEST(LightingProbes, AreRead) {
  LARARIUM_REQUIRE_DATA(folder, "lighting");
  for (const char* name : {"courtyard.exr", "sunset.exr"}) {
    const auto image = ReadProbeImage(folder / name);
    ASSERT_TRUE(image.ok()) << image.message();
    EXPECT_EQ(image->width, 512);
    EXPECT_TRUE(image->warnings.empty());
  }
}

// Splits the image and records what was found at its brightest point.
SplitProbe Found(const std::filesystem::path& file) {
  const auto image = ReadProbeImage(file);
  EXPECT_TRUE(image.ok()) << image.message();
  SplitProbe split = SplitSun(*image);
  const light::Sun& b = split.brightest;
  std::printf(
      "%s: %s; azimuth %.1f, elevation %.1f, radius %.2f degrees, irradiance %.3f %.3f "
      "%.3f, %.1f %% of what falls on a surface facing it\n",
      file.filename().c_str(), split.sun ? "a sun" : "no sun",
      std::atan2(b.direction.x, -b.direction.z) * kDegreesPerRadian,
      std::asin(b.direction.y) * kDegreesPerRadian, b.angular_radius * kDegreesPerRadian,
      b.irradiance.r, b.irradiance.g, b.irradiance.b, 100.0 * split.share);
  return split;
}

TEST(MaquetteProbe, ItsSunIsSplitOffAsItsNotesSay) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  const SplitProbe split = Found(folder / "probe.exr");
  ASSERT_TRUE(split.sun);
  EXPECT_LT(glm::distance(split.sun->direction, glm::vec3(-0.502f, 0.602f, 0.622f)), 0.01f);
  EXPECT_LT(glm::distance(split.sun->irradiance, glm::vec3(5.92f, 5.39f, 4.62f)), 0.12f);
}

TEST(LightingProbes, HoldNoSunWorthAShadow) {
  LARARIUM_REQUIRE_DATA(folder, "lighting");
  EXPECT_FALSE(Found(folder / "courtyard.exr").sun);  // a wide bright opening
  EXPECT_FALSE(Found(folder / "sunset.exr").sun);     // clipped when it was photographed
}

}  // namespace
}  // namespace lararium::bake
