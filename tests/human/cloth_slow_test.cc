// Long versions of the required tests: five minutes of drama, a million jolts.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "shared/core/random.h"
#include "shared/human/cloth.h"
#include "tests/human/walker.h"

namespace lararium::human {
namespace {

TEST(ClothAtLength, FiveMinutesOfWalkingBowingAndCrouchingLetNothingThrough) {
  const Human human = SkirtedWalker(36, 18);
  const ClothModel model(human);
  for (const double rate : {25.0, 120.0}) {
    ClothState state(model);
    WalkerPose walker;
    ClothStep step;
    step.elapsed = static_cast<float>(1.0 / rate);
    step.wind.velocity = {1.5f, 0.0f, 0.5f};
    float deepest = 0.0f;
    int jumps = 0;
    for (int i = 0; i < static_cast<int>(300.0 * rate); ++i) {
      PoseWalker(human, i / rate, walker);
      step.actor_from_joint = walker.actor_from_joint;
      step.stage_from_actor = walker.stage_from_actor;
      const ClothReport report = StepCloth(model, step, state);
      jumps += report.jumped ? 1 : 0;
      ASSERT_FALSE(report.reset) << i / rate;
      // Every fifth frame: measuring costs more than moving.
      if (i % 5 == 0) {
        deepest = std::max(deepest,
                           DeepestPenetration(human, state.particles(0), walker.actor_from_joint));
      }
    }
    EXPECT_LT(deepest, 0.01f) << rate;
    EXPECT_EQ(jumps, 1) << rate;
    RecordProperty("deepest_mm_at_" + std::to_string(static_cast<int>(rate)),
                   std::to_string(deepest * 1000.0f));
  }
}

TEST(ClothAtLength, AMillionJoltsLoseNoParticle) {
  const Human human = SkirtedWalker(8, 3);
  const ClothModel model(human);
  ClothState state(model);
  WalkerPose walker;
  ClothStep step;
  Random random(11);
  for (int i = 0; i < 1'000'000; ++i) {
    if (i % 16 == 0) {
      PoseWalker(human, random.Uniform(0.0, 30.0), walker);
      step.actor_from_joint = walker.actor_from_joint;
    }
    const glm::vec3 place = glm::vec3{random.Normal(), random.Normal(), random.Normal()} * 0.02f;
    step.stage_from_actor =
        glm::rotate(glm::translate(glm::mat4(1.0f), place),
                    static_cast<float>(random.Normal()) * 0.1f, glm::vec3(0.0f, 1.0f, 0.0f));
    step.wind.velocity = glm::vec3{random.Normal(), random.Normal(), random.Normal()} * 10.0f;
    // Each frame is one step of the solver.
    step.elapsed = 1.0f / 120.0f;
    step.detail = ClothDetail::kCoarse;
    StepCloth(model, step, state);
    for (const glm::vec3& p : state.particles(0)) {
      ASSERT_LT(glm::length(p - glm::vec3(0.0f, 0.8f, 0.0f)), 2.0f) << i;
    }
  }
}

}  // namespace
}  // namespace lararium::human
