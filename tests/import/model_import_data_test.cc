#include <assimp/version.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "editor/import/model/model_gltf.h"
#include "editor/import/model/model_import.h"
#include "editor/import/motion/clip_import.h"
#include "shared/core/file.h"
#include "shared/core/random.h"
#include "shared/human/skinning.h"
#include "tests/import/glb_figure.h"
#include "tests/import/plain_figure.h"
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
  // Rigid parts keep their internal distances while the arms rise.
  const auto raised = Skin(*human, *jar, human->clips[0], 1.0);
  const size_t last = raised.size() - 1;
  EXPECT_NEAR(glm::distance(raised[0], raised[last]),
              glm::distance(jar->positions[0], jar->positions[last]), 1e-5f);
  EXPECT_GT(glm::distance(raised[0], jar->positions[0]), 0.3f);
}

TEST(MaquetteOccluder, IsReadInMetresYUp) {
  LARARIUM_REQUIRE_DATA(folder, "maquette");
  std::vector<std::string> notes;
  const auto mesh = ImportMesh(folder / "occluder.glb", notes);
  ASSERT_TRUE(mesh.ok()) << mesh.message();
  // The floor is at 0. The front of the counter is the plane y = 0.9 of the data's Z-up world,
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
    std::vector<std::string> notes;
    const auto mesh = ImportMesh(temporary / "damaged.glb", notes);
    if (mesh.ok()) {
      EXPECT_TRUE(mesh->Validate("damaged").ok());
    }
    (void)ImportHuman(temporary / "damaged.glb").ok();
  }
}

// ---- The figure of the lighting set under other names, axes and units ----

// The figure with renamed nodes and a new root that rotates and scales it.
Result<std::vector<std::byte>> Variant(const std::filesystem::path& file,
                                       const std::function<std::string(const std::string&)>& name,
                                       const Json& root) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, ReadBytes(file));
  LARARIUM_ASSIGN_OR_RETURN(const GltfDocument document, ParseGltf(bytes, file.string()));
  test::GlbFigure figure{document.json, document.buffers.at(0)};
  for (Json& node : figure.json["nodes"]) {
    node["name"] = name(node.value("name", ""));
  }
  Json node = root;
  node["name"] = "Armature";
  node["children"] = figure.json["scenes"][0]["nodes"];
  figure.json["nodes"].push_back(node);
  figure.json["scenes"][0]["nodes"] = {figure.json["nodes"].size() - 1};
  return figure.Glb();
}

TEST(LightingFigure, IsTheSameUnderAnyNamesAxesAndUnits) {
  LARARIUM_REQUIRE_DATA(folder, "lighting");
  const auto original = ImportPerson(folder / "figure.glb");
  ASSERT_TRUE(original.ok()) << original.message();
  ASSERT_TRUE(original->is_human) << original->bone_table;
  const test::TemporaryFolder temporary;
  int count = 0;
  const auto nameless = [&](const std::string&) { return "Node " + std::to_string(count++); };
  const auto same = [](const std::string& name) { return name; };
  const Json z_up_centimetres = {{"rotation", {0.70710678, 0, 0, 0.70710678}},
                                 {"scale", {100, 100, 100}}};
  const Json turned = {{"rotation", {0, 1, 0, 0}}};
  for (const auto& [name, root] :
       {std::pair<std::function<std::string(const std::string&)>, Json>{same, z_up_centimetres},
        {nameless, z_up_centimetres},
        {nameless, turned}}) {
    const auto bytes = Variant(folder / "figure.glb", name, root);
    ASSERT_TRUE(bytes.ok()) << bytes.message();
    ASSERT_TRUE(WriteFileAtomically(temporary / "variant.glb", *bytes).ok());
    const auto variant = ImportPerson(temporary / "variant.glb");
    ASSERT_TRUE(variant.ok()) << variant.message();
    ASSERT_TRUE(variant->is_human) << variant->bone_table;
    const human::Skeleton& a = original->human.skeleton;
    const human::Skeleton& b = variant->human.skeleton;
    for (const char* joint :
         {"humanoid_root", "skullbase", "r_shoulder", "r_elbow", "l_wrist", "l_hip", "r_knee",
          "l_ankle", "r_midtarsal", "l_thumb1", "r_index1", "r_pinky2"}) {
      ASSERT_TRUE(a.Find(joint) && b.Find(joint)) << joint << "\n" << variant->bone_table;
      const glm::vec3 pa = glm::vec3(a.joint_from_actor[*a.Find(joint)][3]);
      const glm::vec3 pb = glm::vec3(b.joint_from_actor[*b.Find(joint)][3]);
      EXPECT_LT(glm::distance(pa, pb), 0.01f) << joint;
    }
  }
}

// ---- Debian's assimp-testmodels ----

#define REQUIRE_MODELS(variable)                                     \
  const std::filesystem::path variable = "/usr/share/assimp/models"; \
  if (!std::filesystem::exists(variable)) {                          \
    GTEST_SKIP() << "needs the Debian package assimp-testmodels";    \
  }                                                                  \
  static_assert(true, "")

struct ModelClaim {
  const char* file;
  // Expected part of the error of ImportPerson and of ImportMotion; empty if it loads.
  const char* person;
  const char* motion;
};

constexpr char kNoSkeleton[] = "no part of it is bound to a skeleton";
constexpr char kNoMesh[] = "there is no mesh of triangles in it";

// The assimp of Debian 13 reads models that the one of Debian 12 refuses.
const bool kNewerAssimp = aiGetVersionMinor() >= 4;

// Every animated model of the package, and every BVH.
const ModelClaim kAnimatedModels[] = {
    {"BVH/01_01.bvh", kNoMesh, ""},
    {"BVH/01_03.bvh", kNoMesh, ""},
    {"BVH/Boxing_Toes.bvh", kNoMesh, ""},
    {"FBX/animation_with_skeleton.fbx", "", ""},
    {"FBX/huesitos.fbx", "", ""},
    {"FBX/spider.fbx", kNoSkeleton, kNoSkeleton},
    {"FBX/transparentTest.fbx", "out of range", "out of range"},
    {"Collada/box_nested_animation.dae", "", ""},
    {"Collada/human.zae", kNoSkeleton, kNoSkeleton},
    {"Collada/library_animation_clips.dae", kNewerAssimp ? "" : "Cannot parse",
     kNewerAssimp ? "" : "Cannot parse"},
    {"Collada/anims_with_full_rotations_between_keys.DAE", kNoSkeleton, "no height"},
    {"glTF2/simple_skin/simple_skin.gltf", "", ""},
    {"glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", kNoSkeleton,
     kNoSkeleton},
    {"glTF2/RecursiveNodes/RecursiveNodes.gltf", "their own ancestors", "their own ancestors"},
    {"glTF2/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "no valid position", kNoSkeleton},
    {"glTF2/MissingBin/BoxTextured.gltf", "is missing", "is missing"},
    {"glTF2/draco/2CylinderEngine.gltf", kNoSkeleton, kNoSkeleton},
    {"X/anim_test.x", "is not in the scene", "is not in the scene"},
    {"IRR/animMesh.irr", kNewerAssimp ? "" : "XML parse error",
     kNewerAssimp ? "" : "XML parse error"},
    {"IRR/scenegraphAnim.irr", kNewerAssimp ? "Validation failed" : "XML parse error",
     kNewerAssimp ? "Validation failed" : "XML parse error"},
    {"OpenGEX/animation_example.ogex", "Not enough values", "Not enough values"},
    {"MD5/SimpleCube.md5mesh", "", "no animation"},
};

void ExpectAnswer(const Result<ImportedHuman>& answer,
                  const std::string& expected,
                  const std::string& claim) {
  if (expected.empty()) {
    ASSERT_TRUE(answer.ok()) << answer.message();
    EXPECT_TRUE(answer->human.Validate(claim).ok());
  } else {
    ASSERT_FALSE(answer.ok()) << claim;
    EXPECT_NE(answer.message().find(expected), std::string::npos) << answer.message();
  }
}

TEST(AssimpModels, AnimatedOnesLoadOrSayWhyNot) {
  REQUIRE_MODELS(models);
  for (const ModelClaim& claim : kAnimatedModels) {
    ExpectAnswer(ImportPerson(models / claim.file), claim.person, claim.file);
    ExpectAnswer(ImportMotion(models / claim.file), claim.motion, claim.file);
  }
}

// For every file of the package in every format, the result is a valid figure or one line that
// names the file.
TEST(AssimpModels, AllAreAnswered) {
  REQUIRE_MODELS(models);
  size_t loaded = 0, refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(models)) {
    if (!entry.is_regular_file() || entry.file_size() > (uintmax_t{20} << 20)) {
      continue;
    }
    const auto person = ImportPerson(entry.path());
    if (person.ok()) {
      ++loaded;
      EXPECT_TRUE(person->human.Validate("person").ok());
    } else {
      ++refused;
      EXPECT_TRUE(person.message().starts_with(entry.path().string() + ": ")) << person.message();
      EXPECT_EQ(person.message().find("crashed"), std::string::npos) << person.message();
    }
  }
  EXPECT_GE(loaded, 27u);
  EXPECT_GE(refused, 400u);
}

// Height of the lowest point of a figure in a pose, metres.
float Lowest(const human::Human& human, const human::Clip& clip, double time) {
  float lowest = std::numeric_limits<float>::max();
  for (const human::SkinnedMesh& mesh : human.meshes) {
    for (const glm::vec3& p : Skin(human, mesh, clip, time)) {
      lowest = std::min(lowest, p.y);
    }
  }
  return lowest;
}

TEST(CapturedClips, PutThePlainFiguresFeetOnTheFloor) {
  REQUIRE_MODELS(models);
  const human::Human& figure = PlainFigure();
  for (const char* file : {"BVH/01_01.bvh", "BVH/Boxing_Toes.bvh"}) {
    ClipImportOptions options;
    options.retarget.name = "captured";
    options.retarget.to = 20.0f;
    const auto imported = ImportClip(models / file, figure.skeleton, options);
    ASSERT_TRUE(imported.ok()) << imported.message();
    EXPECT_NEAR(imported->clip.duration, 20.0f, 0.1f);
    EXPECT_EQ(imported->clip.stride, 0.0f);  // They jump, box and turn.
    std::vector<float> lowest;
    for (double time = 1.0; time < 20.0; time += 0.5) {
      lowest.push_back(Lowest(figure, imported->clip, time));
    }
    std::sort(lowest.begin(), lowest.end());
    EXPECT_GT(lowest.front(), -0.03f) << file;
    EXPECT_NEAR(lowest[lowest.size() / 2], 0.0f, 0.01f) << file;
  }
}

TEST(CapturedClips, BeginWithSpreadArmsAsTheFileDoesWhereThatIsKept) {
  REQUIRE_MODELS(models);
  const human::Human& figure = PlainFigure();
  const auto without = ImportClip(models / "BVH/01_01.bvh", figure.skeleton);
  ClipImportOptions options;
  options.drop_calibration = false;
  const auto imported = ImportClip(models / "BVH/01_01.bvh", figure.skeleton, options);
  ASSERT_TRUE(imported.ok() && without.ok()) << imported.message();
  EXPECT_LT(without->clip.duration, imported->clip.duration);
  EXPECT_FALSE(without->notes.empty());
  std::vector<glm::mat4> actor_from_joint(figure.skeleton.size());
  ComputeActorFromJoint(figure.skeleton,
                        std::span(imported->clip.keys).first(figure.skeleton.size()),
                        actor_from_joint);
  const auto at = [&](const char* joint) {
    return glm::vec3(actor_from_joint[*figure.skeleton.Find(joint)][3]);
  };
  EXPECT_NEAR(at("r_wrist").y, at("r_shoulder").y, 0.1f);
  EXPECT_GT(glm::distance(at("r_wrist"), at("l_wrist")), 1.2f);
}

}  // namespace
}  // namespace lararium::import
