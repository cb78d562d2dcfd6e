#include "shared/light/probe_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shared/core/random.h"
#include "shared/light/quadrature.h"

namespace lararium::light {
namespace {

glm::vec3 Direction(Random& random) {
  return glm::normalize(glm::vec3{random.Normal(), random.Normal(), random.Normal()});
}

TEST(ProjectSun, IsTheIntegralOverAnEvenDisc) {
  // Quadrature over the disc about +Z, where it is exact for polynomials.
  for (const float radius : {0.01f, 0.05f, 0.5f}) {
    const Sun sun{{0, 0, 1}, {3.0f, 2.0f, 1.0f}, radius};
    const double wide = radius;
    const double sine = std::sin(wide);
    const double radiance = 1.0 / (std::numbers::pi * sine * sine);
    const ShRgb projected = ProjectSun(sun);
    std::array<double, kShCount> expected = {};
    for (const SphereNode& node : SphereQuadrature(2 * kShDegree, std::cos(wide), 1.0)) {
      const auto basis = EvaluateShBasis(glm::vec3(node.direction));
      for (int i = 0; i < kShCount; ++i) {
        expected[i] += node.weight * radiance * basis[i];
      }
    }
    for (int i = 0; i < kShCount; ++i) {
      EXPECT_NEAR(projected[i].r, 3.0 * expected[i], 2e-4) << radius << " " << i;
      EXPECT_NEAR(projected[i].b, expected[i], 2e-4) << radius << " " << i;
    }
  }
}

TEST(ProjectSun, FacingItsIrradianceIsWhatItSays) {
  // Degree 5 keeps nearly all of a clamped cosine at its top.
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Sun sun{Direction(random), {3.0f, 2.0f, 1.0f}, 0.00465f};
    const glm::vec3 facing = EvaluateIrradiance(ProjectSun(sun), sun.direction);
    EXPECT_NEAR(facing.r, 3.0f, 0.2f) << "seed 3, sun " << i;
    EXPECT_NEAR(facing.b / facing.r, 1.0f / 3.0f, 1e-4f);
  }
}

TEST(ProbeLight, TurnsAndBrightensSkyAndSunAlike) {
  Random random(5);
  ProbeLight light;
  for (glm::vec3& c : light.sky) {
    c = glm::vec3{random.Normal(), random.Normal(), random.Normal()};
  }
  light.sky[0] = glm::vec3(20.0f);
  light.sun = Sun{Direction(random), {3.0f, 2.0f, 1.0f}, 0.01f};
  const glm::quat turn = glm::angleAxis(1.2f, Direction(random));
  const ProbeLight placed = Placed(light, turn, 2.5f);
  for (int i = 0; i < 20; ++i) {
    const glm::vec3 normal = Direction(random);
    EXPECT_LT(glm::distance(placed.Irradiance(turn * normal), 2.5f * light.Irradiance(normal)),
              1e-3f)
        << "seed 5, normal " << i;
  }
  const ShRgb whole = RotateSh(light.Whole(), turn);
  for (int i = 0; i < kShCount; ++i) {
    EXPECT_LT(glm::distance(placed.Whole()[i], 2.5f * whole[i]), 2e-4f) << i;
  }
}

TEST(ProbeLight, WithoutASunIsItsSky) {
  ProbeLight light;
  light.sky[3] = glm::vec3(1.0f, 2.0f, 3.0f);
  EXPECT_EQ(light.Whole(), light.sky);
}

}  // namespace
}  // namespace lararium::light
