#include "shared/human/spring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "shared/core/random.h"
#include "shared/core/units.h"

namespace lararium::human {
namespace {
constexpr float kLength = 0.1f;

SpringChain Like(float stiffness, float drag, float radius = 0.02f) {
  SpringChain chain;
  chain.stiffness = stiffness;
  chain.drag = drag;
  chain.radius = radius;
  return chain;
}

// A head at 1.6 m and a braid of `joints` joints behind it, hanging or level.
Human Braided(int joints, bool level, const SpringChain& like) {
  Human human;
  human.name = "braided";
  const auto add = [&](const std::string& name, int16_t parent, const glm::vec3& from_parent,
                       const glm::vec3& place) {
    human.skeleton.names.push_back(name);
    human.skeleton.parents.push_back(parent);
    human.skeleton.rest.push_back({.translation = from_parent});
    human.skeleton.joint_from_actor.push_back(glm::translate(glm::mat4(1.0f), -place));
  };
  glm::vec3 place(0.0f, 1.6f, 0.0f);
  add("skullbase", Skeleton::kNoParent, place, place);
  const glm::vec3 step = level ? glm::vec3(0, 0, kLength) : glm::vec3(0, -kLength, 0);
  SpringChain chain = like;
  for (int i = 0; i < joints; ++i) {
    const glm::vec3 from_parent = i == 0 ? glm::vec3(0.0f, 0.0f, 0.1f) : step;
    place += from_parent;
    chain.joints.push_back(static_cast<uint32_t>(i) + 1);
    add("braid" + std::to_string(i), static_cast<int16_t>(i), from_parent, place);
  }
  // A joint that hangs from the end.
  add("ribbon", static_cast<int16_t>(joints), step, place + step);
  human.springs.push_back(chain);
  return human;
}

struct Swinging {
  explicit Swinging(Human person) : human(std::move(person)), model(human), state(model) {}

  // The animation holds its rest pose.
  void Step(float elapsed) {
    step.elapsed = elapsed;
    Pose();
    StepSprings(model, step, state, pose, actor_from_joint);
  }
  void Pose() {
    pose = human.skeleton.rest;
    actor_from_joint.resize(pose.size());
    ComputeActorFromJoint(human.skeleton, pose, actor_from_joint);
  }
  void Run(float seconds, float rate) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds * rate)); ++i) {
      Step(1.0f / rate);
    }
  }
  glm::vec3 Place(size_t joint) const { return glm::vec3(actor_from_joint[joint][3]); }

  Human human;
  SpringModel model;
  SpringState state;
  SpringStep step;
  std::vector<JointTransform> pose;
  std::vector<glm::mat4> actor_from_joint;
};

// Stiffness is per mass and arm: the pull across the stick is stiffness * length * sin(bend), the
// weight across it is g. They balance at tan(sag) = g / (stiffness * length).
TEST(Springs, LevelStickSagsWhereWeightAndStiffnessBalance) {
  Swinging stick(Braided(1, true, Like(200.0f, 5.0f)));
  stick.Run(4.0f, 60.0f);
  const glm::vec3 along = stick.Place(2) - stick.Place(1);
  EXPECT_NEAR(std::atan2(-along.y, along.z), std::atan(9.81f / (200.0f * kLength)), 0.01f);
  EXPECT_NEAR(glm::length(along), kLength, 1e-5f);
}

TEST(Springs, LimpStickSwingsWithThePendulumsPeriod) {
  Swinging stick(Braided(1, false, Like(0.0f, 0.0f)));
  stick.Run(0.5f, 120.0f);
  // A push: the actor moves suddenly, but less than the limit for a jump.
  stick.step.stage_from_actor = glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -0.01f));
  std::vector<double> crossings;
  float before = 0.0f;
  for (int frame = 0; frame < 960; ++frame) {
    stick.Step(1.0f / 120.0f);
    const float z = (stick.Place(2) - stick.Place(1)).z;
    if (before < 0.0f && z >= 0.0f) {
      crossings.push_back((frame + double(-before / (z - before))) / 120.0);
    }
    before = z;
  }
  ASSERT_GE(crossings.size(), 4u);
  const double period =
      (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  const double expected = 2.0 * double(kPiF) * std::sqrt(double(kLength) / 9.81);
  EXPECT_NEAR(period, expected, 0.03 * expected);
}

TEST(Springs, StiffChainFollowsTheAnimationAndALimpOneHangs) {
  for (const float stiffness : {0.0f, 1e6f}) {
    Swinging braid(Braided(5, true, Like(stiffness, 4.0f)));
    braid.Run(4.0f, 60.0f);
    const glm::vec3 whole = braid.Place(6) - braid.Place(1);
    const glm::vec3 expected = stiffness > 0.0f ? glm::vec3(0, 0, 1) : glm::vec3(0, -1, 0);
    EXPECT_GT(glm::dot(whole, expected), 0.99f * 5.0f * kLength) << stiffness;
  }
}

TEST(Springs, KeepsEveryJointsLengthAndTheJointsMatrices) {
  Swinging braid(Braided(5, true, Like(10.0f, 1.0f)));
  for (int frame = 0; frame < 300; ++frame) {
    const float t = static_cast<float>(frame) / 60.0f;
    braid.step.stage_from_actor =
        glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(1.4f * t, 0.0f, 0.0f)),
                    std::sin(3.0f * t), glm::vec3(0, 1, 0));
    braid.Step(1.0f / 60.0f);
    std::vector<glm::mat4> expected(braid.pose.size());
    ComputeActorFromJoint(braid.human.skeleton, braid.pose, expected);
    for (size_t j = 0; j < expected.size(); ++j) {
      EXPECT_LT(glm::distance(glm::vec3(expected[j][3]), braid.Place(j)), 1e-5f);
    }
    for (size_t j = 2; j < expected.size(); ++j) {
      EXPECT_NEAR(glm::distance(braid.Place(j), braid.Place(j - 1)), kLength, 1e-5f);
    }
  }
}

TEST(Springs, SwingAlikeAt25And120FramesASecond) {
  const Human human = Braided(4, true, Like(20.0f, 2.0f));
  Swinging slow(human), fast(human);
  const auto run = [](Swinging& braid, float rate) {
    for (int i = 0; i <= static_cast<int>(3.0f * rate); ++i) {
      const float t = static_cast<float>(i) / rate;
      braid.step.stage_from_actor =
          glm::translate(glm::mat4(1.0f), glm::vec3(0.1f * std::sin(4.0f * t), 0.0f, 0.0f));
      braid.Step(1.0f / rate);
    }
  };
  run(slow, 25.0f);
  run(fast, 120.0f);
  for (size_t j = 1; j < 6; ++j) {
    EXPECT_LT(glm::distance(slow.Place(j), fast.Place(j)), 0.012f) << j;
  }
}

TEST(Springs, StayOutsideTheBody) {
  Human human = Braided(6, true, Like(0.0f, 3.0f, 0.01f));
  // Shoulders below the level braid.
  human.capsules.push_back({0, {-0.2f, -0.25f, 0.3f}, {0.2f, -0.25f, 0.3f}, 0.1f, 0.1f});
  Swinging braid(human);
  for (int frame = 0; frame < 240; ++frame) {
    braid.Step(1.0f / 60.0f);
    for (size_t j = 2; j < 8; ++j) {
      const glm::vec3 p = braid.Place(j) - glm::vec3(0.0f, 1.35f, 0.3f);
      EXPECT_GT(std::hypot(p.y, p.z), 0.1f) << frame << " " << j;
    }
  }
}

TEST(Springs, AreBitForBitTheSame) {
  const Human human = Braided(5, true, {});
  Swinging a(human), b(human);
  for (int i = 0; i < 120; ++i) {
    const float t = static_cast<float>(i) / 50.0f;
    a.step.stage_from_actor = b.step.stage_from_actor =
        glm::rotate(glm::mat4(1.0f), std::sin(t), glm::vec3(0, 1, 0));
    a.Step(0.02f);
    b.Step(0.02f);
    if (i == 60) {
      b.state = a.state;
    }
  }
  for (size_t j = 0; j < 6; ++j) {
    EXPECT_EQ(a.Place(j), b.Place(j));
  }
}

TEST(Springs, HangAsBeforeAfterATeleport) {
  Swinging braid(Braided(4, true, {}));
  braid.Run(4.0f, 60.0f);
  const glm::vec3 before = braid.Place(5);
  braid.step.stage_from_actor =
      glm::rotate(glm::translate(glm::mat4(1.0f), glm::vec3(50, 0, 8)), 2.0f, glm::vec3(0, 1, 0));
  for (int i = 0; i < 30; ++i) {
    braid.Step(1.0f / 60.0f);
    EXPECT_LT(glm::distance(before, braid.Place(5)), 0.01f);
  }
}

TEST(Springs, FadeToTheAnimationAndBackWithoutAJump) {
  Swinging braid(Braided(4, true, {}));
  braid.Run(3.0f, 60.0f);
  glm::vec3 before = braid.Place(5);
  for (int i = 0; i < 240; ++i) {
    braid.step.simulated = i > 90;
    braid.Step(1.0f / 60.0f);
    EXPECT_LT(glm::distance(before, braid.Place(5)), 0.08f) << i;
    before = braid.Place(5);
    if (i == 60) {
      EXPECT_NEAR(before.y, 1.6f, 1e-4f);  // level, equal to the animation
    }
  }
}

TEST(Springs, SurviveJoltsAndInputThatIsNotFinite) {
  Swinging braid(Braided(6, true, Like(1e5f, 0.0f)));
  Random random(5);
  for (int i = 0; i < 3000; ++i) {
    braid.step.stage_from_actor = glm::translate(
        glm::mat4(1.0f), glm::vec3{random.Normal(), random.Normal(), random.Normal()} * 0.1f);
    if (i % 50 == 7) {
      braid.step.stage_from_actor[3].x = std::numeric_limits<float>::quiet_NaN();
    }
    braid.Step(static_cast<float>(random.Uniform(0.0, 0.05)));
    for (size_t j = 1; j < 8; ++j) {
      ASSERT_LT(glm::distance(braid.Place(j), glm::vec3(0.0f, 1.6f, 0.1f)), 0.61f);
    }
  }
}

}  // namespace
}  // namespace lararium::human
