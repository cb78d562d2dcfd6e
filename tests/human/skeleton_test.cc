#include "shared/human/skeleton.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tests/human/two_joint_human.h"

namespace lararium::human {
namespace {

using ::testing::HasSubstr;
constexpr float kQuarter = std::numbers::pi_v<float> / 2.0f;

TEST(ComputeActorFromJoint, ChainsRotationsDownTheSkeleton) {
  const Human human = TwoJointHuman();
  std::vector<JointTransform> pose = human.skeleton.rest;
  pose[0].rotation = glm::angleAxis(kQuarter, glm::vec3(0, 0, 1));  // +x to +y
  pose[1].rotation = glm::angleAxis(kQuarter, glm::vec3(0, 0, 1));
  std::vector<glm::mat4> actor_from_joint(2);
  ComputeActorFromJoint(human.skeleton, pose, actor_from_joint);
  // The elbow is above the shoulder; the forearm points to -x.
  EXPECT_LT(glm::distance(glm::vec3(actor_from_joint[1][3]), glm::vec3(0, 2, 0)), 1e-6f);
  const glm::vec3 hand(actor_from_joint[1] * glm::vec4(1, 0, 0, 1));
  EXPECT_LT(glm::distance(hand, glm::vec3(-1, 2, 0)), 1e-6f);
}

TEST(ComputeActorFromJoint, ScalesBeforeItRotates) {
  const Human human = TwoJointHuman();
  std::vector<JointTransform> pose = human.skeleton.rest;
  pose[0].scale = glm::vec3(2.0f, 1.0f, 1.0f);
  pose[0].rotation = glm::angleAxis(kQuarter, glm::vec3(0, 0, 1));
  std::vector<glm::mat4> actor_from_joint(2);
  ComputeActorFromJoint(human.skeleton, pose, actor_from_joint);
  EXPECT_LT(glm::distance(glm::vec3(actor_from_joint[1][3]), glm::vec3(0, 3, 0)), 1e-6f);
}

TEST(ComputeSkinMatrices, AreTheIdentityInTheBindPose) {
  const Human human = TwoJointHuman();
  std::vector<glm::mat4> actor_from_joint(2), skin(2);
  ComputeActorFromJoint(human.skeleton, human.skeleton.rest, actor_from_joint);
  ComputeSkinMatrices(human.skeleton, actor_from_joint, skin);
  for (const glm::mat4& matrix : skin) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_LT(glm::distance(matrix[column], glm::mat4(1.0f)[column]), 1e-6f);
    }
  }
}

TEST(Skeleton, FindsJointsByName) {
  const Skeleton skeleton = TwoJointHuman().skeleton;
  EXPECT_EQ(skeleton.Find("l_elbow"), 1u);
  EXPECT_EQ(skeleton.Find("r_elbow"), std::nullopt);
}

TEST(SkeletonValidate, AcceptsAWholeSkeleton) {
  EXPECT_TRUE(TwoJointHuman().skeleton.Validate("here").ok());
}

TEST(SkeletonValidate, RefusesAnEmptyOne) { EXPECT_FALSE(Skeleton().Validate("here").ok()); }

TEST(SkeletonValidate, NamesTheJointThatPrecedesItsParent) {
  Skeleton skeleton = TwoJointHuman().skeleton;
  skeleton.parents = {1, Skeleton::kNoParent};
  const Status status = skeleton.Validate("figure.larhuman");
  ASSERT_FALSE(status.ok());
  EXPECT_THAT(status.message(), HasSubstr("figure.larhuman"));
  EXPECT_THAT(status.message(), HasSubstr("l_shoulder"));
}

TEST(SkeletonValidate, RefusesImpossibleNumbers) {
  Skeleton skeleton = TwoJointHuman().skeleton;
  skeleton.rest[1].rotation = glm::quat(0, 0, 0, 0);
  EXPECT_FALSE(skeleton.Validate("here").ok());
  skeleton = TwoJointHuman().skeleton;
  skeleton.joint_from_actor[0][3].x = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(skeleton.Validate("here").ok());
  skeleton = TwoJointHuman().skeleton;
  skeleton.joint_from_actor[0][0].w = 0.5f;
  EXPECT_FALSE(skeleton.Validate("here").ok());
}

TEST(SkeletonValidate, RefusesDoubleNamesAndUnequalArrays) {
  Skeleton skeleton = TwoJointHuman().skeleton;
  skeleton.names[1] = skeleton.names[0];
  EXPECT_FALSE(skeleton.Validate("here").ok());
  skeleton = TwoJointHuman().skeleton;
  skeleton.rest.pop_back();
  EXPECT_FALSE(skeleton.Validate("here").ok());
}

}  // namespace
}  // namespace lararium::human
