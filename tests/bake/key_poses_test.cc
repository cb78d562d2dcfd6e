#include "editor/bake/key_poses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "shared/human/animator.h"
#include "tests/human/full_body.h"
#include "tests/human/two_joint_human.h"

namespace lararium::bake {
namespace {

using human::Human;
using human::JointTransform;
using human::LightTransfer;
using Poses = std::vector<std::vector<JointTransform>>;

std::vector<LightTransfer::Blocker> OnEveryJoint(const Human& human) {
  std::vector<LightTransfer::Blocker> blockers;
  for (uint32_t joint = 0; joint < human.skeleton.size(); ++joint) {
    const glm::mat4 actor_from_joint = glm::inverse(human.skeleton.joint_from_actor[joint]);
    blockers.push_back({joint, glm::vec3(actor_from_joint[3]) + glm::vec3(0.1f, 0.0f, 0.0f), 0.1f});
  }
  return blockers;
}

// Cosine of half the largest difference of a joint's rotation.
float Alike(const std::vector<JointTransform>& a, const std::vector<JointTransform>& b) {
  float least = 1.0f;
  for (size_t j = 0; j < a.size(); ++j) {
    least = std::min(least, std::abs(glm::dot(a[j].rotation, b[j].rotation)));
  }
  return least;
}

TEST(KeyPoses, SomebodyWhoWalksStartsWithStanding) {
  const auto person = std::make_shared<const Human>(human::FullBody(0.4f, 7));
  const Poses poses = ChooseKeyPoses(person, OnEveryJoint(*person), 6);
  ASSERT_EQ(poses.size(), 6u);
  const auto model = human::MakeAnimationRig(person);
  human::Animator animator(model);
  human::AnimationState performance;
  human::UpdateAnimationState(*model, glm::vec3(0.0f), 0.0f, 1.0f / 60.0f, {}, performance);
  animator.Pose(performance);
  const std::vector<JointTransform> standing(animator.pose().begin(), animator.pose().end());
  EXPECT_GT(Alike(poses[0], standing), 1.0f - 1e-5f);
  for (size_t i = 0; i < poses.size(); ++i) {
    ASSERT_EQ(poses[i].size(), person->skeleton.size());
    for (size_t k = 0; k < i; ++k) {
      EXPECT_LT(Alike(poses[i], poses[k]), 1.0f - 1e-4f) << i << ", " << k;
    }
  }
}

TEST(KeyPoses, WhatCannotWalkStartsAtRestAndTakesItsClips) {
  const auto arm = std::make_shared<const Human>(human::TwoJointHuman());
  const Poses poses = ChooseKeyPoses(arm, OnEveryJoint(*arm), 3);
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_GT(Alike(poses[0], arm->skeleton.rest), 1.0f - 1e-6f);
  // The pose farthest from rest is the quarter turn of the forearm. A rotation of the whole
  // changes nothing relative to the pelvis.
  EXPECT_NEAR(
      2.0f * std::acos(std::abs(glm::dot(poses[1][1].rotation, arm->skeleton.rest[1].rotation))),
      0.5f * 3.14159265f, 1e-3f);
  EXPECT_GT(Alike({poses[1][0]}, {arm->skeleton.rest[0]}), 1.0f - 1e-6f);
}

TEST(KeyPoses, NoPoseComesTwiceHoweverManyAreWanted) {
  const auto arm = std::make_shared<const Human>(human::TwoJointHuman());
  const Poses poses = ChooseKeyPoses(arm, OnEveryJoint(*arm), 100);
  // Five keys of the bending clip, a quarter of a second apart, the first at rest.
  EXPECT_EQ(poses.size(), 5u);
  EXPECT_EQ(ChooseKeyPoses(arm, {}, 100).size(), 1u);
}

}  // namespace
}  // namespace lararium::bake
