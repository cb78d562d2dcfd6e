#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/human/two_joint_human.h"
#include "tests/support/test_files.h"

namespace lararium::human {
namespace {

using ::testing::HasSubstr;

TEST(HumanFile, RoundTripKeepsEverything) {
  const Human human = TwoJointHuman();
  const auto parsed = ParseHuman(SerializeHuman(human), "here");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->name, human.name);
  EXPECT_EQ(parsed->credits, human.credits);
  EXPECT_EQ(parsed->skeleton.names, human.skeleton.names);
  EXPECT_EQ(parsed->skeleton.parents, human.skeleton.parents);
  EXPECT_EQ(parsed->skeleton.joint_from_actor, human.skeleton.joint_from_actor);
  ASSERT_EQ(parsed->meshes.size(), 1u);
  EXPECT_EQ(parsed->meshes[0].name, human.meshes[0].name);
  EXPECT_EQ(parsed->meshes[0].positions, human.meshes[0].positions);
  EXPECT_EQ(parsed->meshes[0].normals, human.meshes[0].normals);
  EXPECT_EQ(parsed->meshes[0].albedo, human.meshes[0].albedo);
  EXPECT_EQ(parsed->meshes[0].joints, human.meshes[0].joints);
  EXPECT_EQ(parsed->meshes[0].weights, human.meshes[0].weights);
  EXPECT_EQ(parsed->meshes[0].indices, human.meshes[0].indices);
  ASSERT_EQ(parsed->clips.size(), 2u);
  EXPECT_EQ(parsed->clips[1].name, "turn");
  EXPECT_TRUE(parsed->clips[1].loops);
  EXPECT_EQ(parsed->clips[1].stride, 1.25f);
  ASSERT_EQ(parsed->clips[0].keys.size(), human.clips[0].keys.size());
  for (size_t i = 0; i < human.clips[0].keys.size(); ++i) {
    EXPECT_EQ(parsed->clips[0].keys[i].rotation, human.clips[0].keys[i].rotation);
    EXPECT_EQ(parsed->clips[0].keys[i].translation, human.clips[0].keys[i].translation);
  }
}

// The two-joint human with one of everything that a person can have.
Human RichHuman() {
  Human human = TwoJointHuman();
  human.skinning = Skinning::kDualQuaternion;
  const std::string png = "\x89PNG and so on";
  human.textures.resize(1);
  human.textures[0].name = "wool";
  for (const char c : png) {
    human.textures[0].encoded.push_back(static_cast<std::byte>(c));
  }
  human.materials = {
      {"wool", Surface::kCloth, 0, Material::kNone, {0.5f, 0.25f, 1.0f}, 0.75f, 0.5f, true}};
  SkinnedMesh& mesh = human.meshes[0];
  mesh.material = 0;
  mesh.uvs = {{0.0f, 0.0f}, {0.5f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}};
  mesh.coarser = {{0.01f, {0, 1, 3}}, {0.5f, {}}};
  human.morphs = {{"jaw", {{0, {1, 3}, {{0, -1, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, 1, 0}}}}}};
  human.face = {{"aa", {{0, 0.75f}}, {{1, glm::quat(0.6f, 0.8f, 0.0f, 0.0f)}}}};
  Cloth cloth;
  cloth.name = "hem";
  cloth.positions = {{0, 1, 0}, {1, 1, 0}, {0, 0, 0}};
  cloth.joints.assign(3, {0, 1, 0, 0});
  cloth.weights.assign(3, glm::vec4(0.25f, 0.75f, 0.0f, 0.0f));
  cloth.reach = {0.0f, 0.0f, 0.5f};
  cloth.triangles = {0, 1, 2};
  cloth.vertex_triangle = {0, 0, Cloth::kUnbound, 0};
  cloth.vertex_weights.assign(4, glm::vec3(0.5f, 0.25f, 0.01f));
  cloth.density = 0.3f;
  cloth.friction = 0.2f;
  human.cloths = {cloth};
  human.springs = {{"plait", {0, 1}, 5.0f, 2.0f, 0.5f, 0.01f}};
  human.capsules = {{1, {0, 0, 0}, {1, 0, 0}, 0.06f, 0.04f}};
  return human;
}

TEST(HumanFile, RoundTripKeepsSurfacesAndTheirDetail) {
  const Human human = RichHuman();
  const auto parsed = ParseHuman(SerializeHuman(human), "here");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->skinning, Skinning::kDualQuaternion);
  ASSERT_EQ(parsed->textures.size(), 1u);
  EXPECT_EQ(parsed->textures[0].name, "wool");
  EXPECT_EQ(parsed->textures[0].encoded, human.textures[0].encoded);
  ASSERT_EQ(parsed->materials.size(), 1u);
  EXPECT_EQ(parsed->materials[0].name, "wool");
  EXPECT_EQ(parsed->materials[0].surface, Surface::kCloth);
  EXPECT_EQ(parsed->materials[0].colour_texture, 0);
  EXPECT_EQ(parsed->materials[0].normal_texture, Material::kNone);
  EXPECT_EQ(parsed->materials[0].colour, human.materials[0].colour);
  EXPECT_EQ(parsed->materials[0].roughness, 0.75f);
  EXPECT_EQ(parsed->materials[0].alpha_cutoff, 0.5f);
  EXPECT_TRUE(parsed->materials[0].two_sided);
  EXPECT_EQ(parsed->meshes[0].material, 0);
  EXPECT_EQ(parsed->meshes[0].uvs, human.meshes[0].uvs);
  ASSERT_EQ(parsed->meshes[0].coarser.size(), 2u);
  EXPECT_EQ(parsed->meshes[0].coarser[0].error, 0.01f);
  EXPECT_EQ(parsed->meshes[0].coarser[0].indices, human.meshes[0].coarser[0].indices);
}

TEST(HumanFile, RoundTripKeepsTheFace) {
  const Human human = RichHuman();
  const auto parsed = ParseHuman(SerializeHuman(human), "here");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  ASSERT_EQ(parsed->morphs.size(), 1u);
  EXPECT_EQ(parsed->morphs[0].name, "jaw");
  ASSERT_EQ(parsed->morphs[0].parts.size(), 1u);
  EXPECT_EQ(parsed->morphs[0].parts[0].vertices, human.morphs[0].parts[0].vertices);
  EXPECT_EQ(parsed->morphs[0].parts[0].position_deltas, human.morphs[0].parts[0].position_deltas);
  EXPECT_EQ(parsed->morphs[0].parts[0].normal_deltas, human.morphs[0].parts[0].normal_deltas);
  ASSERT_EQ(parsed->face.size(), 1u);
  EXPECT_EQ(parsed->face[0].name, "aa");
  EXPECT_EQ(parsed->face[0].morphs[0].weight, 0.75f);
  EXPECT_EQ(parsed->face[0].turns[0].joint, 1u);
  EXPECT_EQ(parsed->face[0].turns[0].rotation, human.face[0].turns[0].rotation);
}

TEST(HumanFile, RoundTripKeepsWhatMovesByItself) {
  const Human human = RichHuman();
  const auto parsed = ParseHuman(SerializeHuman(human), "here");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  ASSERT_EQ(parsed->cloths.size(), 1u);
  const Cloth& cloth = parsed->cloths[0];
  EXPECT_EQ(cloth.name, "hem");
  EXPECT_EQ(cloth.positions, human.cloths[0].positions);
  EXPECT_EQ(cloth.joints, human.cloths[0].joints);
  EXPECT_EQ(cloth.weights, human.cloths[0].weights);
  EXPECT_EQ(cloth.reach, human.cloths[0].reach);
  EXPECT_EQ(cloth.triangles, human.cloths[0].triangles);
  EXPECT_EQ(cloth.vertex_triangle, human.cloths[0].vertex_triangle);
  EXPECT_EQ(cloth.vertex_weights, human.cloths[0].vertex_weights);
  EXPECT_EQ(cloth.density, 0.3f);
  EXPECT_EQ(cloth.friction, 0.2f);
  ASSERT_EQ(parsed->springs.size(), 1u);
  EXPECT_EQ(parsed->springs[0].joints, human.springs[0].joints);
  EXPECT_EQ(parsed->springs[0].stiffness, 5.0f);
  ASSERT_EQ(parsed->capsules.size(), 1u);
  EXPECT_EQ(parsed->capsules[0].b, human.capsules[0].b);
  EXPECT_EQ(parsed->capsules[0].radius_b, 0.04f);
}

TEST(HumanFile, TheSameHumanGivesTheSameBytes) {
  EXPECT_EQ(SerializeHuman(RichHuman()), SerializeHuman(RichHuman()));
}

TEST(HumanFile, SavesAndLoads) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(SaveHuman(folder / "a.larhuman", TwoJointHuman()).ok());
  EXPECT_TRUE(LoadHuman(folder / "a.larhuman").ok());
  EXPECT_FALSE(LoadHuman(folder / "b.larhuman").ok());
}

TEST(HumanFile, WillNotSaveWhatItWouldNotLoad) {
  const test::TemporaryFolder folder;
  Human human = TwoJointHuman();
  human.meshes[0].indices[0] = 99;
  EXPECT_FALSE(SaveHuman(folder / "a.larhuman", human).ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "a.larhuman"));
}

TEST(HumanFile, RefusesOtherFilesByName) {
  const std::vector<std::byte> zeros(1000);
  const auto parsed = ParseHuman(zeros, "photo.jpg");
  ASSERT_FALSE(parsed.ok());
  EXPECT_THAT(parsed.message(), HasSubstr("photo.jpg"));
  EXPECT_FALSE(ParseHuman({}, "empty").ok());
}

TEST(HumanFile, RefusesWhatIsInconsistent) {
  const auto refuses = [](auto&& change) {
    Human human = RichHuman();
    change(human);
    return !ParseHuman(SerializeHuman(human), "here").ok();
  };
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].joints[2][0] = 7; }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].indices[1] = 4; }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].indices.pop_back(); }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].weights[0].x = 0.5f; }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].normals[0] = glm::vec3(0.0f); }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].albedo.pop_back(); }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].albedo[1].g = 1.5f; }));
  EXPECT_TRUE(refuses([](Human& h) { h.skeleton.parents[1] = 1; }));
  EXPECT_TRUE(refuses([](Human& h) { h.clips[0].keys.pop_back(); }));
  EXPECT_TRUE(refuses([](Human& h) { h.skinning = static_cast<Skinning>(2); }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].uvs.pop_back(); }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].material = 1; }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].coarser[0].indices[0] = 4; }));
  EXPECT_TRUE(refuses([](Human& h) { h.meshes[0].coarser[0].error = -1.0f; }));
}

TEST(HumanFile, RefusesSurfacesThatCannotBe) {
  const auto refuses = [](auto&& change) {
    Human human = RichHuman();
    change(human);
    return !ParseHuman(SerializeHuman(human), "here").ok();
  };
  EXPECT_TRUE(refuses([](Human& h) { h.textures[0].encoded[0] = std::byte{'G'}; }));
  EXPECT_TRUE(refuses([](Human& h) { h.textures[0].encoded.clear(); }));
  EXPECT_TRUE(refuses([](Human& h) { h.materials[0].colour_texture = 1; }));
  EXPECT_TRUE(refuses([](Human& h) { h.materials[0].normal_texture = -2; }));
  EXPECT_TRUE(refuses([](Human& h) { h.materials[0].surface = static_cast<Surface>(9); }));
  EXPECT_TRUE(refuses([](Human& h) { h.materials[0].roughness = std::nanf(""); }));
  EXPECT_TRUE(refuses([](Human& h) { h.materials[0].colour.b = 2.0f; }));
}

TEST(HumanFile, RefusesFacesAndSoftPartsThatCannotBe) {
  const auto refuses = [](auto&& change) {
    Human human = RichHuman();
    change(human);
    return !ParseHuman(SerializeHuman(human), "here").ok();
  };
  EXPECT_TRUE(refuses([](Human& h) { h.morphs[0].parts[0].mesh = 1; }));
  EXPECT_TRUE(refuses([](Human& h) { h.morphs[0].parts.push_back(h.morphs[0].parts[0]); }));
  EXPECT_TRUE(refuses([](Human& h) { h.morphs[0].parts[0].vertices = {3, 1}; }));
  EXPECT_TRUE(refuses([](Human& h) { h.morphs[0].parts[0].vertices = {1, 4}; }));
  EXPECT_TRUE(refuses([](Human& h) { h.morphs[0].parts[0].normal_deltas.pop_back(); }));
  EXPECT_TRUE(refuses([](Human& h) { h.morphs[0].parts[0].position_deltas[0].x = INFINITY; }));
  EXPECT_TRUE(refuses([](Human& h) { h.face[0].morphs[0].morph = 1; }));
  EXPECT_TRUE(refuses([](Human& h) { h.face[0].turns[0].joint = 2; }));
  EXPECT_TRUE(refuses([](Human& h) { h.face[0].turns[0].rotation.w = 2.0f; }));
  EXPECT_TRUE(refuses([](Human& h) { h.cloths[0].mesh = 1; }));
  EXPECT_TRUE(refuses([](Human& h) { h.cloths.push_back(h.cloths[0]); }));
  EXPECT_TRUE(refuses([](Human& h) { h.cloths[0].reach[1] = -0.1f; }));
  EXPECT_TRUE(refuses([](Human& h) { h.cloths[0].joints[1][1] = 2; }));
  EXPECT_TRUE(refuses([](Human& h) { h.cloths[0].triangles[1] = 3; }));
  EXPECT_TRUE(refuses([](Human& h) { h.cloths[0].vertex_triangle[0] = 1; }));
  EXPECT_TRUE(refuses([](Human& h) { h.cloths[0].vertex_weights.pop_back(); }));
  EXPECT_TRUE(refuses([](Human& h) { h.cloths[0].density = 0.0f; }));
  EXPECT_TRUE(refuses([](Human& h) { h.springs[0].joints = {1, 0}; }));
  EXPECT_TRUE(refuses([](Human& h) { h.springs[0].drag = -1.0f; }));
  EXPECT_TRUE(refuses([](Human& h) { h.capsules[0].joint = 2; }));
  EXPECT_TRUE(refuses([](Human& h) { h.capsules[0].radius_a = std::nanf(""); }));
}

TEST(HumanFile, RefusesEveryTruncation) {
  const std::vector<std::byte> bytes = SerializeHuman(RichHuman());
  for (size_t length = 0; length < bytes.size(); ++length) {
    // A copy of its own size, so that sanitizers see any read beyond it.
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<long>(length));
    EXPECT_FALSE(ParseHuman(cut, "cut").ok()) << length;
  }
}

TEST(HumanFile, SurvivesFlippedBits) {
  const std::vector<std::byte> bytes = SerializeHuman(RichHuman());
  Random random(3);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::byte> damaged = bytes;
    for (uint32_t flips = 1 + random.Below(4); flips > 0; --flips) {
      damaged[random.Below(static_cast<uint32_t>(damaged.size()))] ^=
          static_cast<std::byte>(1u << random.Below(8));
    }
    const auto parsed = ParseHuman(damaged, "damaged");
    if (parsed.ok()) {
      EXPECT_TRUE(parsed->Validate("damaged").ok());
    }
  }
}

TEST(HumanFile, ReadsBytesAtAnyAddress) {
  const std::vector<std::byte> bytes = SerializeHuman(TwoJointHuman());
  std::vector<std::byte> shifted(bytes.size() + 1);
  std::copy(bytes.begin(), bytes.end(), shifted.begin() + 1);
  EXPECT_TRUE(ParseHuman(std::span(shifted).subspan(1), "shifted").ok());
}

}  // namespace
}  // namespace lararium::human
