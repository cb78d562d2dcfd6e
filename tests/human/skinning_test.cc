#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "tests/human/two_joint_human.h"

namespace lararium::human {
namespace {

struct Skinned {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
};

Skinned Skin(const Human& human, const std::vector<JointTransform>& pose) {
  std::vector<glm::mat4> actor_from_joint(pose.size()), skin(pose.size());
  ComputeActorFromJoint(human.skeleton, pose, actor_from_joint);
  ComputeSkinMatrices(human.skeleton, actor_from_joint, skin);
  const SkinnedMesh& mesh = human.meshes[0];
  Skinned result{std::vector<glm::vec3>(mesh.positions.size()),
                 std::vector<glm::vec3>(mesh.positions.size())};
  SkinMesh(mesh, skin, result.positions, result.normals);
  return result;
}

TEST(SkinMesh, LeavesTheBindPoseAsItIs) {
  const Human human = TwoJointHuman();
  const Skinned skinned = Skin(human, human.skeleton.rest);
  for (size_t v = 0; v < skinned.positions.size(); ++v) {
    EXPECT_LT(glm::distance(skinned.positions[v], human.meshes[0].positions[v]), 1e-6f);
    EXPECT_LT(glm::distance(skinned.normals[v], human.meshes[0].normals[v]), 1e-6f);
  }
}

TEST(SkinMesh, MovesVerticesWithTheirJoints) {
  const Human human = TwoJointHuman();
  std::vector<JointTransform> pose = human.skeleton.rest;
  pose[1].rotation = glm::angleAxis(std::numbers::pi_v<float> / 2.0f, glm::vec3(0, 0, 1));
  const Skinned skinned = Skin(human, pose);
  // The upper arm stays; (2, 1.1) was (1, 0.1) in the forearm, now (-0.1, 1).
  EXPECT_LT(glm::distance(skinned.positions[0], glm::vec3(0.0f, 1.1f, 0.0f)), 1e-6f);
  EXPECT_LT(glm::distance(skinned.positions[2], glm::vec3(0.9f, 2.0f, 0.0f)), 1e-6f);
  EXPECT_LT(glm::distance(skinned.normals[2], glm::vec3(-1.0f, 0.0f, 0.0f)), 1e-6f);
  // Half of each at the elbow: the mean of (1, 1.1) and (0.9, 1).
  EXPECT_LT(glm::distance(skinned.positions[1], glm::vec3(0.95f, 1.05f, 0.0f)), 1e-6f);
  EXPECT_NEAR(glm::length(skinned.normals[1]), 1.0f, 1e-6f);
}

}  // namespace
}  // namespace lararium::human
