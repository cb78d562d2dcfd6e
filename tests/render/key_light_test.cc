#include "shared/render/passes/key_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shared/core/random.h"

namespace lararium::render {
namespace {

// A directional light in a uniform light.
light::ShRgb Lit(const glm::vec3& direction, const glm::vec3& irradiance, float even) {
  light::ShRgb light = {};
  const auto basis = light::EvaluateShBasis(direction);
  for (int i = 0; i < light::kShCount; ++i) {
    light[i] = irradiance * basis[i];
  }
  light[0] += glm::vec3(even * 2.0f * std::sqrt(std::numbers::pi_v<float>));
  return light;
}

TEST(KeyLight, FindsALampInEvenLight) {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const glm::vec3 direction =
        glm::normalize(glm::vec3{random.Normal(), random.Normal(), random.Normal()});
    const glm::vec3 irradiance{random.Uniform(0.5, 3), random.Uniform(0.5, 3),
                               random.Uniform(0.5, 3)};
    const KeyLight key = EstimateKeyLight(Lit(direction, irradiance, 0.3f));
    EXPECT_LT(glm::distance(key.direction, direction), 1e-4f) << "seed 1, lamp " << i;
    EXPECT_LT(glm::distance(key.irradiance, irradiance), 1e-4f) << "seed 1, lamp " << i;
  }
}

TEST(KeyLight, EvenLightHasNone) {
  EXPECT_EQ(EstimateKeyLight(Lit({0, 1, 0}, glm::vec3(0.0f), 1.0f)).irradiance, glm::vec3(0.0f));
  EXPECT_EQ(EstimateKeyLight({}).irradiance, glm::vec3(0.0f));
}

TEST(KeyLight, IsNeverMoreThanAllThereIs) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    light::ShRgb light;
    for (glm::vec3& c : light) {
      c = glm::vec3{random.Normal(), random.Normal(), random.Normal()};
    }
    light[0] = glm::abs(light[0]);
    const KeyLight key = EstimateKeyLight(light);
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(key.irradiance[c], 0.0f);
      EXPECT_LE(key.irradiance[c],
                light[0][c] * 2.0f * std::sqrt(std::numbers::pi_v<float>) * 1.001f);
    }
  }
}

}  // namespace
}  // namespace lararium::render
