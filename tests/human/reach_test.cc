#include "shared/human/reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/random.h"
#include "shared/human/turns.h"
#include "shared/human/two_bone_ik.h"
#include "tests/human/full_body.h"

namespace lararium::human {
namespace {

using Pose = std::vector<JointTransform>;

float GripAngle(const glm::quat& a, const glm::quat& b) {
  return 2.0f * std::acos(std::min(std::abs(glm::dot(a, b)), 1.0f));
}

GripFrame Grip(float x, float y, float z, const glm::quat& rotation = kNoTurn) {
  return {glm::vec3(x, y, z), rotation};
}

// Moves both hands to their grips, as the Animator does.
void ApplyBoth(const ReachModel& model,
               const Skeleton& skeleton,
               const std::array<Reach, 2>& reaches,
               Pose& pose) {
  ApplyReachPosture(model, skeleton, reaches, 0.0f, pose);
  for (const int side : {kRight, kLeft}) {
    ApplyReach(model, skeleton, reaches[static_cast<size_t>(side)], side, pose);
  }
}

TEST(TwoBoneIk, BringsTheEndToAnyTargetWithinReach) {
  const Human human = FullBody(0.4f, 5);
  const BodyRig body = MakeBodyRig(human.skeleton);
  const BodyRig::Arm& arm = body.arms[kRight];
  const glm::vec3 shoulder = body.rest[static_cast<size_t>(arm.shoulder)].position;
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    Pose pose = human.skeleton.rest;
    TwoBoneIk ik;
    ik.upper = arm.shoulder;
    ik.lower = arm.elbow;
    ik.end = arm.wrist;
    const glm::vec3 way{random.Normal(), random.Normal(), random.Normal()};
    const float length = arm.upper_length + arm.lower_length;
    ik.target =
        shoulder + static_cast<float>(random.Uniform(0.2, 0.99)) * length * glm::normalize(way);
    ik.pole = glm::vec3{random.Normal(), random.Normal(), random.Normal()};
    ik.hinge = glm::vec3(0.0f, -1.0f, 0.0f);
    const float missed = ik.Solve(human.skeleton, body, pose);
    const JointFrame wrist = ActorFromJoint(human.skeleton, pose, arm.wrist);
    EXPECT_LT(glm::distance(wrist.position, ik.target), 2e-4f);
    EXPECT_LT(missed, 1e-4f);
    // The elbow is on the pole's side of the line from shoulder to wrist.
    const glm::vec3 elbow = ActorFromJoint(human.skeleton, pose, arm.elbow).position;
    const glm::vec3 line = glm::normalize(ik.target - shoulder);
    EXPECT_GE(glm::dot(Across(elbow - shoulder, line), Across(ik.pole, line)), -1e-5f);
  }
}

TEST(TwoBoneIk, StretchesSoftlyTowardsWhatIsTooFar) {
  const Human human = FullBody(0.4f, 0);
  const BodyRig body = MakeBodyRig(human.skeleton);
  const BodyRig::Arm& arm = body.arms[kRight];
  const glm::vec3 shoulder = body.rest[static_cast<size_t>(arm.shoulder)].position;
  const float length = arm.upper_length + arm.lower_length;
  float before = 0.0f;
  for (float share = 0.9f; share < 1.5f; share += 0.005f) {
    Pose pose = human.skeleton.rest;
    TwoBoneIk ik{arm.shoulder,        arm.elbow,
                 arm.wrist,           shoulder + share * length * glm::vec3(1, 0, 0),
                 glm::vec3(0, -1, 0), glm::vec3(0, -1, 0)};
    ik.Solve(human.skeleton, body, pose);
    const float reached =
        glm::distance(ActorFromJoint(human.skeleton, pose, arm.wrist).position, shoulder);
    EXPECT_GE(reached, before - 1e-5f);  // never back
    EXPECT_LT(reached, length);          // never straight
    before = reached;
  }
}

TEST(Reach, PutsThePalmWithinFiveMillimetresOfEveryGripAtHand) {
  const GripFrame grips[] = {Grip(0.20f, 1.00f, -0.45f),
                             Grip(0.15f, 1.05f, -0.50f, TurnZ(-kPiF / 2)),
                             Grip(0.10f, 1.00f, -0.80f, TurnZ(-kPiF / 2)),
                             Grip(0.30f, 1.85f, -0.25f, TurnX(1.0f)),
                             Grip(0.25f, 0.45f, -0.40f, TurnZ(-kPiF / 2)),
                             Grip(0.20f, 0.10f, -0.35f),
                             Grip(-0.25f, 1.10f, -0.35f, TurnY(0.6f)),
                             Grip(0.06f, 1.50f, -0.20f, TurnY(1.4f))};
  for (const float arms : {0.0f, 0.8f}) {
    for (const uint64_t axes : {0u, 9u}) {
      const Human human = FullBody(arms, axes);
      const ReachModel model = MakeReachModel(MakeBodyRig(human.skeleton));
      for (const GripFrame& grip : grips) {
        std::array<Reach, 2> reaches;
        StartReach(reaches[kRight], grip, 1.0f);
        UpdateReach(reaches[kRight], 1.0f);
        Pose pose = human.skeleton.rest;
        ApplyBoth(model, human.skeleton, reaches, pose);
        const GripFrame palm = ActorFromPalm(model, human.skeleton, pose, kRight);
        EXPECT_LT(glm::distance(palm.position, grip.position), 0.005f);
        EXPECT_LT(GripAngle(palm.rotation, grip.rotation), 0.01f);
      }
    }
  }
}

TEST(Reach, MirrorsForTheLeftHand) {
  const Human human = FullBody(0.8f, 0);
  const ReachModel model = MakeReachModel(MakeBodyRig(human.skeleton));
  std::array<Reach, 2> reaches;
  StartReach(reaches[kRight], Grip(0.2f, 1.0f, -0.4f), 0.0f);
  StartReach(reaches[kLeft], Grip(-0.2f, 1.0f, -0.4f), 0.0f);
  Pose pose = human.skeleton.rest;
  ApplyBoth(model, human.skeleton, reaches, pose);
  for (const char* name : {"shoulder", "elbow", "wrist", "index1"}) {
    const auto at = [&](const std::string& joint) {
      return ActorFromJoint(human.skeleton, pose,
                            static_cast<JointIndex>(*human.skeleton.Find(joint)))
          .position;
    };
    const glm::vec3 right = at(std::string("r_") + name), left = at(std::string("l_") + name);
    EXPECT_LT(glm::distance(right, left * glm::vec3(-1, 1, 1)), 1e-3f) << name;
  }
}

TEST(Reach, KeepsTheFeetWhereTheyAreWhenItCrouches) {
  const Human human = FullBody(0.8f, 4);
  const ReachModel model = MakeReachModel(MakeBodyRig(human.skeleton));
  std::array<Reach, 2> reaches;
  StartReach(reaches[kRight], Grip(0.2f, 0.10f, -0.35f), 0.0f);
  Pose pose = human.skeleton.rest;
  ApplyBoth(model, human.skeleton, reaches, pose);
  const auto height = [&](const Pose& of, JointIndex joint) {
    return ActorFromJoint(human.skeleton, of, joint).position.y;
  };
  EXPECT_LT(height(pose, model.body.root), height(human.skeleton.rest, model.body.root) - 0.1f);
  for (const BodyRig::Leg& leg : model.body.legs) {
    EXPECT_LT(glm::distance(ActorFromJoint(human.skeleton, pose, leg.ankle).position,
                            model.body.rest[static_cast<size_t>(leg.ankle)].position),
              0.001f);
  }
}

TEST(Reach, GoesAndComesBackWithoutAJump) {
  const Human human = FullBody(0.8f, 6);
  const ReachModel model = MakeReachModel(MakeBodyRig(human.skeleton));
  std::array<Reach, 2> reaches;
  Reach& reach = reaches[kRight];
  glm::vec3 before = ActorFromPalm(model, human.skeleton, human.skeleton.rest, kRight).position;
  const glm::vec3 home = before;
  float fastest = 0.0f;
  for (int tick = 0; tick < 360; ++tick) {
    if (tick == 10) {
      StartReach(reach, Grip(0.2f, 1.0f, -0.45f), 0.8f);
    } else if (tick == 60) {  // The goal changes during the motion.
      StartReach(reach, Grip(0.0f, 1.2f, -0.40f, TurnY(0.5f)), 0.8f);
    } else if (tick == 200) {
      EndReach(reach, 0.7f);
    }
    UpdateReach(reach, 1.0f / 120.0f);
    Pose pose = human.skeleton.rest;
    ApplyBoth(model, human.skeleton, reaches, pose);
    const glm::vec3 now = ActorFromPalm(model, human.skeleton, pose, kRight).position;
    fastest = std::max(fastest, glm::distance(now, before));
    before = now;
  }
  EXPECT_LT(fastest, 0.025f);  // 3 m/s
  EXPECT_LT(glm::distance(before, home), 1e-4f);
}

TEST(Reach, OfWeightZeroChangesNothing) {
  const Human human = FullBody(0.8f, 6);
  const ReachModel model = MakeReachModel(MakeBodyRig(human.skeleton));
  Pose pose = human.skeleton.rest;
  ApplyBoth(model, human.skeleton, {}, pose);
  for (size_t i = 0; i < pose.size(); ++i) {
    EXPECT_EQ(pose[i].rotation, human.skeleton.rest[i].rotation);
  }
}

TEST(Reach, LeavesBodiesWithoutArmsAlone) {
  Human human = FullBody(0.8f, 6);
  human.skeleton.names[*human.skeleton.Find("r_elbow")] = "something";
  const ReachModel model = MakeReachModel(MakeBodyRig(human.skeleton));
  std::array<Reach, 2> reaches;
  StartReach(reaches[kRight], Grip(0.2f, 1.0f, -0.45f), 0.0f);
  Pose pose = human.skeleton.rest;
  ApplyBoth(model, human.skeleton, reaches, pose);
  EXPECT_EQ(pose[3].rotation, human.skeleton.rest[3].rotation);
}

}  // namespace
}  // namespace lararium::human
