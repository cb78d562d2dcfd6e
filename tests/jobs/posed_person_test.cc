#include "editor/jobs/posed_person.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/human/human.h"
#include "tests/human/cloth_of_mesh.h"
#include "tests/import/plain_figure.h"

namespace lararium::editor {
namespace {

constexpr uint32_t kTip = 12;

// 3x5 vertices that are attached to one joint and extend backwards from it.
human::SkinnedMesh Strip(const human::Skeleton& skeleton, const char* joint) {
  const auto index = static_cast<uint8_t>(import::IndexOfJoint(skeleton, joint));
  const glm::vec3 root = import::RestPosition(skeleton, joint);
  human::SkinnedMesh mesh;
  mesh.name = joint;
  for (uint32_t row = 0; row < 5; ++row) {
    for (uint32_t column = 0; column < 3; ++column) {
      mesh.positions.push_back(root + 0.1f * glm::vec3(column, 0.0f, row));
      mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
      mesh.albedo.emplace_back(0.5f);
      mesh.joints.push_back({index, index, index, index});
      mesh.weights.emplace_back(1.0f, 0.0f, 0.0f, 0.0f);
      if (row > 0 && column > 0) {
        const uint32_t v = 3 * row + column;
        mesh.indices.insert(mesh.indices.end(), {v - 4, v, v - 3, v - 4, v - 1, v});
      }
    }
  }
  return mesh;
}

// A skeleton with a cape and a face that can smile.
std::shared_ptr<const human::Human> Somebody() {
  human::Human human;
  human.name = "somebody";
  human.skeleton = import::PlainSkeleton();
  human.meshes = {Strip(human.skeleton, "skullbase"), Strip(human.skeleton, "vt4")};
  human.morphs = {{"up", {{0, {kTip}, {glm::vec3(0.0f, 0.1f, 0.0f)}, {glm::vec3(0.0f)}}}}};
  human.face = {{"joy", {{0, 1.0f}}, {}}};
  human.cloths = {ClothOf(human.meshes[1], 1, 1.0f)};
  EXPECT_TRUE(human.Validate("somebody").ok()) << human.Validate("somebody").message();
  return std::make_shared<const human::Human>(std::move(human));
}

glm::vec3 JointOf(const PosedPerson& person, const char* name) {
  return person.actor_from_joint()[import::IndexOfJoint(person.human().skeleton, name)][3];
}

TEST(PosedPerson, StandsWithTheArmsDown) {
  const auto human = Somebody();
  const PosedPerson person(human, {});
  const glm::vec3 at_rest = import::RestPosition(human->skeleton, "l_wrist");
  EXPECT_LT(std::abs(JointOf(person, "l_wrist").x), std::abs(at_rest.x) - 0.1f);
}

TEST(PosedPerson, ClothHasFallenIntoPlace) {
  const PosedPerson person(Somebody(), {});
  const std::vector<glm::vec3> cape = person.ComputePositions()[1];
  // The cape hangs down from its upper edge, except where the back holds it.
  EXPECT_LT(cape[kTip].y, cape[0].y - 0.3f);
  EXPECT_NEAR(glm::distance(cape[kTip], cape[0]), 0.4f, 0.04f);
}

TEST(PosedPerson, WhoWalksStridesOverTheSamePlace) {
  StudioPose walking;
  walking.walk = 2.0;
  const PosedPerson person(Somebody(), walking);
  const glm::vec3 left = JointOf(person, "l_ankle");
  const glm::vec3 right = JointOf(person, "r_ankle");
  EXPECT_GT(std::abs(left.z - right.z) + std::abs(left.y - right.y), 0.1f);
  EXPECT_LT(std::abs(0.5f * (left.z + right.z)), 0.4f);
}

TEST(PosedPerson, AnotherFaceLeavesTheBodyAlone) {
  PosedPerson person(Somebody(), {});
  ASSERT_EQ(person.vertices().size(), 1u);  // The cape.
  const std::vector<std::vector<glm::vec3>> before = person.ComputePositions();
  const std::vector<StudioPose::Shape> joy = {{0, 0.5f}};
  person.SetShapes(joy);
  ASSERT_EQ(person.vertices().size(), 2u);
  const render::SceneVertices& face = person.vertices()[1];
  EXPECT_FALSE(face.posed);
  EXPECT_NEAR(face.positions[kTip].y, person.human().meshes[0].positions[kTip].y + 0.05f, 1e-5f);
  EXPECT_EQ(person.ComputePositions(), before);
}

}  // namespace
}  // namespace lararium::editor
