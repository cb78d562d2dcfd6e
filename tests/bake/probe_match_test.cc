#include "editor/bake/probe_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shared/core/random.h"

namespace lararium::bake {
namespace {

using ::testing::HasSubstr;

glm::vec3 Direction(Random& random) {
  return glm::normalize(glm::vec3{random.Normal(), random.Normal(), random.Normal()});
}
glm::quat Rotation(Random& random) {
  return glm::angleAxis(static_cast<float>(random.Uniform(0.0, 3.0)), Direction(random));
}

TEST(ProbeMatch, DraggingBringsTheSunThereByTheLeastMotion) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const glm::quat before = Rotation(random);
    const glm::vec3 sun = Direction(random);
    const glm::vec3 goal = Direction(random);
    const glm::quat after = DraggedTo(before, sun, goal);
    EXPECT_LT(glm::distance(after * sun, goal), 1e-5f) << "seed 1, " << i;
    const float least = std::acos(glm::clamp(glm::dot(before * sun, goal), -1.0f, 1.0f));
    const glm::quat motion = after * glm::conjugate(before);
    EXPECT_NEAR(2.0f * std::acos(std::min(1.0f, std::abs(motion.w))), least, 2e-3f) << i;
  }
  const glm::vec3 up(0, 1, 0);
  EXPECT_LT(glm::distance(LeastRotation(up, -up) * up, -up), 1e-5f);
  EXPECT_LT(glm::distance(LeastRotation(up, up) * up, up), 1e-6f);
}

TEST(ProbeMatch, TurningKeepsTheProbeLevel) {
  const glm::quat level = glm::angleAxis(0.4f, glm::vec3(0, 1, 0));
  const glm::vec3 sun = glm::normalize(glm::vec3(1, 1, 0));
  const glm::vec3 goal = glm::normalize(glm::vec3(0, 0.3f, 1));
  const glm::quat turned = TurnedTo(level, sun, goal);
  EXPECT_LT(glm::distance(turned * glm::vec3(0, 1, 0), glm::vec3(0, 1, 0)), 1e-5f);
  const glm::vec3 at = turned * sun;
  EXPECT_NEAR(std::atan2(at.x, at.z), std::atan2(goal.x, goal.z), 1e-4f);
  EXPECT_EQ(TurnedTo(level, {0, 1, 0}, goal), level);
}

TEST(ProbeMatch, TwoDirectionsGiveTheRotation) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const glm::quat truth = Rotation(random);
    const glm::vec3 a = Direction(random);
    const glm::vec3 b = Direction(random);
    if (std::abs(glm::dot(a, b)) > 0.98f) {
      continue;
    }
    const auto match = MatchDirections({a, truth * a}, {b, truth * b});
    ASSERT_TRUE(match.ok()) << match.message();
    EXPECT_NEAR(std::abs(glm::dot(match->stage_from_probe, truth)), 1.0f, 1e-5f) << "seed 2, " << i;
    EXPECT_LT(match->residual, 1e-3f);
  }
}

TEST(ProbeMatch, DirectionsThatDisagreeShareTheError) {
  // The directions are 90 degrees apart in the probe and 80 on the stage, so each is off by 5
  // degrees.
  const glm::vec3 a(1, 0, 0);
  const glm::vec3 b(0, 1, 0);
  const float angle = 80.0f * std::numbers::pi_v<float> / 180.0f;
  const auto match = MatchDirections({a, a}, {b, {std::cos(angle), std::sin(angle), 0.0f}});
  ASSERT_TRUE(match.ok());
  const float expected = 5.0f * std::numbers::pi_v<float> / 180.0f;
  EXPECT_NEAR(match->residual, expected, 1e-4f);
  EXPECT_NEAR(std::acos(glm::dot(match->stage_from_probe * a, a)), expected, 1e-3f);
  EXPECT_THAT(MatchDirections({a, a}, {a, b}).message(), HasSubstr("nearly the same"));
}

light::ProbeLight Light() {
  light::ProbeLight light;
  light.sky[0] = glm::vec3(2.0f, 2.2f, 2.6f);
  light.sky[1] = glm::vec3(0.5f);
  light.sun = light::Sun{glm::normalize(glm::vec3(1, 2, 0.5f)), {3, 2.8f, 2.4f}, 0.005f};
  return light;
}

GreyPatch Seen(const light::ProbeLight& light, const glm::vec3& normal, float scale) {
  GreyPatch patch;
  patch.normal = normal;
  patch.gain = {0.8f, 0.9f, 1.1f};
  patch.albedo = glm::vec3(0.18f, 0.17f, 0.16f);
  patch.linear =
      scale * patch.gain * patch.albedo * light.Irradiance(normal) / std::numbers::pi_v<float>;
  return patch;
}

TEST(ProbeMatch, GreySurfacesGiveTheScale) {
  const GreyPatch patches[] = {Seen(Light(), {0, 1, 0}, 0.7f), Seen(Light(), {1, 0, 0}, 0.7f)};
  const auto match = MatchScale(Light(), patches);
  ASSERT_TRUE(match.ok()) << match.message();
  EXPECT_NEAR(match->scale, 0.7f, 1e-5f);
  EXPECT_LT(match->residual, 1e-5f);
  EXPECT_LT(glm::distance(match->balance, glm::vec3(1.0f)), 1e-5f);
}

TEST(ProbeMatch, SaysHowFarGreySurfacesDisagree) {
  // One patch is a stop too bright, the other a stop too dark.
  const GreyPatch patches[] = {Seen(Light(), {0, 1, 0}, 1.0f), Seen(Light(), {1, 0, 0}, 0.25f)};
  const auto match = MatchScale(Light(), patches);
  ASSERT_TRUE(match.ok()) << match.message();
  EXPECT_NEAR(match->scale, 0.5f, 1e-5f);
  EXPECT_NEAR(match->residual, 1.0f, 1e-4f);
}

TEST(ProbeMatch, RefusesPatchesThatSayNothing) {
  GreyPatch patch = Seen(Light(), {0, 1, 0}, 1.0f);
  EXPECT_FALSE(MatchScale(Light(), {}).ok());
  patch.linear.g = 1.0f;
  EXPECT_THAT(MatchScale(Light(), {&patch, 1}).message(), HasSubstr("pick 1 is black or clipped"));
  patch = Seen(Light(), {0, 1, 0}, 1.0f);
  patch.albedo = glm::vec3(0.0f);
  EXPECT_THAT(MatchScale(Light(), {&patch, 1}).message(), HasSubstr("does not light"));
  patch.albedo = glm::vec3(NAN);
  EXPECT_FALSE(MatchScale(Light(), {&patch, 1}).ok());
}

}  // namespace
}  // namespace lararium::bake
