#include "shared/human/skinning.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "shared/core/random.h"
#include "shared/core/units.h"
#include "tests/human/two_joint_human.h"

namespace lararium::human {
namespace {

struct Skinned {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
};

Skinned Skin(const Human& human,
             const std::vector<JointTransform>& pose,
             Skinning skinning = Skinning::kLinear) {
  std::vector<glm::mat4> actor_from_joint(pose.size()), skin(pose.size());
  ComputeActorFromJoint(human.skeleton, pose, actor_from_joint);
  ComputeSkinMatrices(human.skeleton, actor_from_joint, skin);
  const SkinnedMesh& mesh = human.meshes[0];
  Skinned result{std::vector<glm::vec3>(mesh.positions.size()),
                 std::vector<glm::vec3>(mesh.positions.size())};
  SkinMesh(mesh, skin, result.positions, result.normals, skinning);
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
  // The elbow takes half of each: the mean of (1, 1.1) and (0.9, 1).
  EXPECT_LT(glm::distance(skinned.positions[1], glm::vec3(0.95f, 1.05f, 0.0f)), 1e-6f);
  EXPECT_NEAR(glm::length(skinned.normals[1]), 1.0f, 1e-6f);
}

glm::mat4 RandomMotion(Random& random, float scale) {
  glm::mat4 matrix = glm::mat4_cast(glm::normalize(
      glm::quat{static_cast<float>(random.Normal()), static_cast<float>(random.Normal()),
                static_cast<float>(random.Normal()), static_cast<float>(random.Normal())}));
  matrix = glm::scale(matrix, glm::vec3(scale));
  matrix[3] = glm::vec4{random.Normal(), random.Normal(), random.Normal(), 1.0f};
  return matrix;
}

// Vertices that follow random joints.
struct RandomSkin {
  explicit RandomSkin(uint64_t seed, size_t joint_count, size_t count) {
    Random random(seed);
    for (size_t i = 0; i < joint_count; ++i) {
      skin.push_back(RandomMotion(random, 1.0f));
    }
    for (size_t v = 0; v < count; ++v) {
      positions.push_back({random.Normal(), random.Normal(), random.Normal()});
      normals.push_back(glm::normalize(positions.back()));
      const auto joint = [&] {
        return static_cast<uint8_t>(random.Below(static_cast<uint32_t>(joint_count)));
      };
      joints.push_back({joint(), joint(), joint(), joint()});
      glm::vec4 w{random.Uniform(0, 1), random.Uniform(0, 1), random.Uniform(0, 1), 0.0f};
      weights.push_back(w / (w.x + w.y + w.z + w.w));
    }
  }
  Skinned Run(Skinning skinning) const {
    Skinned result{std::vector<glm::vec3>(positions.size()),
                   std::vector<glm::vec3>(positions.size())};
    SkinningJob{positions, normals,  joints,           weights,
                skin,      skinning, result.positions, result.normals}
        .Run();
    return result;
  }

  std::vector<glm::mat4> skin;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<std::array<uint8_t, 4>> joints;
  std::vector<glm::vec4> weights;
};

TEST(SkinningJob, LinearIsTheWeightedMeanOfTheMatrices) {
  const RandomSkin world(3, 16, 200);
  const Skinned skinned = world.Run(Skinning::kLinear);
  for (size_t v = 0; v < world.positions.size(); ++v) {
    glm::vec3 position(0.0f);
    glm::vec3 normal(0.0f);
    for (int k = 0; k < 4; ++k) {
      const glm::mat4& m = world.skin[world.joints[v][k]];
      position += world.weights[v][k] * glm::vec3(m * glm::vec4(world.positions[v], 1.0f));
      normal += world.weights[v][k] * (glm::mat3(m) * world.normals[v]);
    }
    EXPECT_LT(glm::distance(skinned.positions[v], position), 1e-5f) << "seed 3, vertex " << v;
    EXPECT_LT(glm::distance(skinned.normals[v], glm::normalize(normal)), 1e-4f)
        << "seed 3, vertex " << v;
  }
}

TEST(DualQuaternion, MovesAPointAsItsMatrixDoes) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const glm::mat4 matrix = RandomMotion(random, static_cast<float>(random.Uniform(0.3, 3.0)));
    const DualQuaternion q = ToDualQuaternion(matrix);
    const glm::vec3 point{random.Normal(), random.Normal(), random.Normal()};
    const glm::quat translation = 2.0f * (q.dual * glm::conjugate(q.real));
    const glm::vec3 moved =
        q.real * (q.scale * point) + glm::vec3(translation.x, translation.y, translation.z);
    EXPECT_LT(glm::distance(moved, glm::vec3(matrix * glm::vec4(point, 1.0f))), 1e-4f)
        << "seed 4, motion " << i;
    EXPECT_NEAR(glm::length(q.real), 1.0f, 1e-5f);
    EXPECT_NEAR(glm::dot(q.real, q.dual), 0.0f, 1e-4f);
  }
}

TEST(SkinningJob, OneJointAloneMovesRigidlyEitherWay) {
  RandomSkin world(5, 8, 100);
  for (glm::vec4& weights : world.weights) {
    weights = glm::vec4(0.0f, 1.0f, 0.0f, 0.0f);
  }
  const Skinned linear = world.Run(Skinning::kLinear);
  const Skinned dual = world.Run(Skinning::kDualQuaternion);
  for (size_t v = 0; v < world.positions.size(); ++v) {
    EXPECT_LT(glm::distance(linear.positions[v], dual.positions[v]), 1e-5f);
    EXPECT_LT(glm::distance(linear.normals[v], dual.normals[v]), 1e-5f);
  }
}

TEST(SkinningJob, AHalfTwistKeepsItsRadiusWithDualQuaternionsAlone) {
  const auto radius_at = [](float twist, Skinning skinning) {
    const std::array skin = {glm::mat4(1.0f),
                             glm::rotate(glm::mat4(1.0f), twist, glm::vec3(0.0f, 1.0f, 0.0f))};
    const glm::vec3 position(1.0f, 0.5f, 0.0f);
    const glm::vec3 normal(1.0f, 0.0f, 0.0f);
    const std::array<uint8_t, 4> joints = {0, 1, 0, 0};
    const glm::vec4 weights(0.5f, 0.5f, 0.0f, 0.0f);
    glm::vec3 moved;
    glm::vec3 turned;
    SkinningJob{{&position, 1}, {&normal, 1}, {&joints, 1}, {&weights, 1},
                skin,           skinning,     {&moved, 1},  {&turned, 1}}
        .Run();
    EXPECT_NEAR(moved.y, 0.5f, 1e-5f);
    return std::hypot(moved.x, moved.z);
  };
  for (const float twist : {0.5f, 1.5f, 2.5f, 3.0f}) {
    EXPECT_NEAR(radius_at(twist, Skinning::kLinear), std::cos(0.5f * twist), 1e-5f) << twist;
    EXPECT_NEAR(radius_at(twist, Skinning::kDualQuaternion), 1.0f, 1e-5f) << twist;
  }
}

TEST(SkinningJob, SignsOfQuaternionsDoNotMatter) {
  // Two rotations that differ by a few degrees, but whose quaternions have opposite signs, must
  // blend to a rotation between them.
  const glm::vec3 axis(0.0f, 0.0f, 1.0f);
  const std::array skin = {glm::rotate(glm::mat4(1.0f), kPiF - 0.1f, axis),
                           glm::rotate(glm::mat4(1.0f), kPiF + 0.1f, axis)};
  const glm::vec3 position(1.0f, 0.0f, 0.0f);
  const std::array<uint8_t, 4> joints = {0, 1, 0, 0};
  const glm::vec4 weights(0.5f, 0.5f, 0.0f, 0.0f);
  glm::vec3 moved;
  glm::vec3 normal;
  SkinningJob{{&position, 1}, {&position, 1}, {&joints, 1},
              {&weights, 1},  skin,           Skinning::kDualQuaternion,
              {&moved, 1},    {&normal, 1}}
      .Run();
  EXPECT_LT(glm::distance(moved, glm::vec3(-1.0f, 0.0f, 0.0f)), 1e-5f);
}

}  // namespace
}  // namespace lararium::human
