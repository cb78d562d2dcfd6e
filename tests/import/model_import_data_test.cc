#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "editor/import/model_import.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "shared/human/skinning.h"
#include "tests/support/test_files.h"

namespace lararium::import {
namespace {

std::vector<glm::vec3> Skin(const human::Human& human,
                            const human::SkinnedMesh& mesh,
                            const human::Clip& clip,
                            double time) {
  std::vector<human::JointTransform> pose(human.skeleton.size());
  std::vector<glm::mat4> actor_from_joint(pose.size()), skin(pose.size());
  human::SampleClip(clip, time, pose);
  human::ComputeActorFromJoint(human.skeleton, pose, actor_from_joint);
  human::ComputeSkinMatrices(human.skeleton, actor_from_joint, skin);
  std::vector<glm::vec3> positions(mesh.positions.size()), normals(mesh.positions.size());
  human::SkinMesh(mesh, skin, positions, normals);
  return positions;
}

TEST(LightingFigure, HasItsPartsColoursAndClip) {
  LARARIUM_REQUIRE_DATA(folder, "lighting");
  const auto human = ImportHuman(folder / "figure.glb");
  ASSERT_TRUE(human.ok()) << human.message();
  EXPECT_EQ(human->meshes.size(), 7u);
  ASSERT_EQ(human->clips.size(), 1u);
  EXPECT_EQ(human->clips[0].name, "poses");
  EXPECT_NEAR(human->clips[0].duration, 4.0f, 1e-3f);
  for (const human::SkinnedMesh& mesh : human->meshes) {
    if (mesh.name == "body") {
      EXPECT_EQ(mesh.positions.size(), 13380u);
      EXPECT_EQ(mesh.indices.size(), 3u * 26756u);
      EXPECT_LT(glm::distance(mesh.albedo[0], glm::vec3(0.45f, 0.28f, 0.20f)), 1e-5f);
    }
  }
}

TEST(LightingFigure, StandsOnTheFloorFacingForwards) {
  LARARIUM_REQUIRE_DATA(folder, "lighting");
  const auto human = ImportHuman(folder / "figure.glb");
  ASSERT_TRUE(human.ok()) << human.message();
  float lowest = 10.0f, highest = 0.0f;
  for (const human::SkinnedMesh& mesh : human->meshes) {
    for (const glm::vec3& p : mesh.positions) {
      lowest = std::min(lowest, p.y);
      highest = std::max(highest, p.y);
    }
  }
  EXPECT_NEAR(lowest, 0.0f, 0.01f);
  EXPECT_NEAR(highest, 1.77f, 0.03f);
  const auto position = [&](const char* name) {
    const auto joint = human->skeleton.Find(name);
    EXPECT_TRUE(joint.has_value()) << name;
    return glm::vec3(glm::inverse(human->skeleton.joint_from_actor[joint.value_or(0)])[3]);
  };
  EXPECT_LT(position("l_wrist").x, -0.2f);
  EXPECT_GT(position("r_wrist").x, 0.2f);
  EXPECT_LT(position("r_midtarsal").z, position("r_ankle").z - 0.05f);
}

TEST(LightingFigure, IsInItsBindPoseAtTheStartOfTheClip) {
  LARARIUM_REQUIRE_DATA(folder, "lighting");
  const auto human = ImportHuman(folder / "figure.glb");
  ASSERT_TRUE(human.ok()) << human.message();
  for (const human::SkinnedMesh& mesh : human->meshes) {
    const auto positions = Skin(*human, mesh, human->clips[0], 0.0);
    float largest = 0.0f;
    for (size_t v = 0; v < positions.size(); ++v) {
      largest = std::max(largest, glm::distance(positions[v], mesh.positions[v]));
    }
    EXPECT_LT(largest, 1e-4f) << mesh.name;
  }
}

TEST(LightingFigure, KeepsTheJarInTheHand) {
  LARARIUM_REQUIRE_DATA(folder, "lighting");
  const auto human = ImportHuman(folder / "figure.glb");
  ASSERT_TRUE(human.ok()) << human.message();
  const auto jar = std::find_if(human->meshes.begin(), human->meshes.end(),
                                [](const auto& mesh) { return mesh.name == "amphora"; });
  ASSERT_NE(jar, human->meshes.end());
  // Rigid: distances within it stay the same while the arms rise.
  const auto raised = Skin(*human, *jar, human->clips[0], 1.0);
  const size_t last = raised.size() - 1;
  EXPECT_NEAR(glm::distance(raised[0], raised[last]),
              glm::distance(jar->positions[0], jar->positions[last]), 1e-5f);
  EXPECT_GT(glm::distance(raised[0], jar->positions[0]), 0.3f);
}

TEST(MaquetteOccluder, IsReadInMetresYUp) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  const auto mesh = ImportMesh(folder / "occluder.glb");
  ASSERT_TRUE(mesh.ok()) << mesh.message();
  // Floor at 0; the counter's front is the plane y = 0.9 of the data's Z-up world,
  // z = -0.9 here, and reaches from x = -1.25 to 2.2.
  float lowest = 100.0f;
  bool front = false;
  for (const glm::vec3& p : mesh->positions) {
    lowest = std::min(lowest, p.y);
    front = front || (std::abs(p.z + 0.9f) < 0.03f && std::abs(p.x - 2.2f) < 0.03f);
  }
  EXPECT_NEAR(lowest, 0.0f, 0.03f);
  EXPECT_TRUE(front);
}

TEST(DamagedModels, NeverCrashTheImporter) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  const auto whole = ReadBytes(folder / "occluder.glb");
  ASSERT_TRUE(whole.ok());
  const test::TemporaryFolder temporary;
  Random random(5);
  for (int trial = 0; trial < 150; ++trial) {
    std::vector<std::byte> bytes = *whole;
    if (trial < 60) {
      bytes.resize(bytes.size() * trial / 60);
    } else {
      for (int flips = 0; flips < 8; ++flips) {
        bytes[random.Below(static_cast<uint32_t>(bytes.size()))] ^=
            static_cast<std::byte>(1u << random.Below(8));
      }
    }
    ASSERT_TRUE(WriteFileAtomically(temporary / "damaged.glb", bytes).ok());
    const auto mesh = ImportMesh(temporary / "damaged.glb");
    if (mesh.ok()) {
      EXPECT_TRUE(mesh->Validate("damaged").ok());
    }
    (void)ImportHuman(temporary / "damaged.glb").ok();
  }
}

}  // namespace
}  // namespace lararium::import
