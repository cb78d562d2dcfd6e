#include "shared/human/morph.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "tests/human/two_joint_human.h"

namespace lararium::human {
namespace {

// Two targets that share vertex 1.
Human WithMorphs() {
  Human human = TwoJointHuman();
  MorphTarget up{"up", {{0, {0, 1}, {{0, 1, 0}, {0, 2, 0}}, {{0, 0, 0}, {1, 0, 0}}}}};
  MorphTarget out{"out", {{0, {1, 3}, {{0, 0, 1}, {0, 0, 3}}, {{0, 0, 0}, {0, 0, 0}}}}};
  human.morphs = {up, out};
  return human;
}

struct Morphed {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
};

Morphed Morph(const Human& human, const std::vector<float>& weights) {
  const SkinnedMesh& mesh = human.meshes[0];
  Morphed result{std::vector<glm::vec3>(mesh.positions.size()),
                 std::vector<glm::vec3>(mesh.positions.size())};
  const std::vector<MeshMorphs> morphs = FindMeshMorphs(human);
  EXPECT_EQ(morphs.size(), 1u);
  MorphJob{mesh, morphs[0], weights, result.positions, result.normals}.Run();
  return result;
}

TEST(MorphJob, AddsWeightedDisplacements) {
  const Human human = WithMorphs();
  ASSERT_TRUE(human.Validate("test").ok());
  const SkinnedMesh& mesh = human.meshes[0];
  const Morphed morphed = Morph(human, {0.5f, -1.0f});
  EXPECT_EQ(morphed.positions[0], mesh.positions[0] + glm::vec3(0.0f, 0.5f, 0.0f));
  EXPECT_EQ(morphed.positions[1], mesh.positions[1] + glm::vec3(0.0f, 1.0f, -1.0f));
  EXPECT_EQ(morphed.positions[2], mesh.positions[2]);
  EXPECT_EQ(morphed.positions[3], mesh.positions[3] + glm::vec3(0.0f, 0.0f, -3.0f));
}

TEST(MorphJob, NormalsStayUnitVectors) {
  const Human human = WithMorphs();
  const Morphed morphed = Morph(human, {1.0f, 0.0f});
  const glm::vec3 expected =
      glm::normalize(human.meshes[0].normals[1] + glm::vec3(1.0f, 0.0f, 0.0f));
  EXPECT_LT(glm::distance(morphed.normals[1], expected), 1e-6f);
}

TEST(MorphJob, ANormalThatVanishesStaysThatOfTheBindPose) {
  Human human = WithMorphs();
  human.morphs[0].parts[0].normal_deltas[0] = -human.meshes[0].normals[0];
  EXPECT_EQ(Morph(human, {1.0f, 0.0f}).normals[0], human.meshes[0].normals[0]);
}

TEST(MorphJob, WithoutWeightsGivesTheBindPose) {
  const Human human = WithMorphs();
  const Morphed morphed = Morph(human, {0.0f, 0.0f});
  EXPECT_EQ(morphed.positions, human.meshes[0].positions);
  EXPECT_EQ(morphed.normals, human.meshes[0].normals);
}

TEST(MeshMorphs, KnowWhetherAnyOfTheirTargetsIsSeen) {
  Human human = WithMorphs();
  human.meshes.push_back(human.meshes[0]);
  human.morphs.push_back({"other", {{1, {0}, {{1, 0, 0}}, {{0, 0, 0}}}}});
  const std::vector<MeshMorphs> morphs = FindMeshMorphs(human);
  ASSERT_EQ(morphs.size(), 2u);
  EXPECT_FALSE(morphs[0].Active(std::vector<float>{0.0f, 0.0f, 1.0f}));
  EXPECT_TRUE(morphs[1].Active(std::vector<float>{0.0f, 0.0f, 1.0f}));
  EXPECT_TRUE(morphs[0].Active(std::vector<float>{0.0f, -0.2f, 0.0f}));
}

}  // namespace
}  // namespace lararium::human
