#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/human/rich_human.h"
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

TEST(HumanFile, RoundTripKeepsSurfacesAndTheirDetail) {
  const Human human = RichHuman();
  const auto parsed = ParseHuman(SerializeHuman(human), "here");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->skinning, Skinning::kDualQuaternion);
  ASSERT_EQ(parsed->textures.size(), 1u);
  EXPECT_EQ(parsed->textures[0]->name, "wool");
  EXPECT_EQ(parsed->textures[0]->encoded, human.textures[0]->encoded);
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

TEST(HumanFile, RoundTripKeepsTheLightTransfer) {
  const Human human = RichHuman();
  const auto parsed = ParseHuman(SerializeHuman(human), "here");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  const LightTransfer& light = parsed->light;
  EXPECT_EQ(light.count, 9);
  EXPECT_EQ(light.bounces, 2);
  ASSERT_EQ(light.key_poses.size(), 2u);
  for (size_t pose = 0; pose < 2; ++pose) {
    ASSERT_EQ(light.key_poses[pose].size(), 2u);
    for (size_t joint = 0; joint < 2; ++joint) {
      const JointTransform& expected = human.light.key_poses[pose][joint];
      EXPECT_EQ(light.key_poses[pose][joint].rotation, expected.rotation);
      EXPECT_EQ(light.key_poses[pose][joint].translation, expected.translation);
      EXPECT_EQ(light.key_poses[pose][joint].scale, expected.scale);
    }
  }
  ASSERT_EQ(light.blockers.size(), 2u);
  EXPECT_EQ(light.blockers[1].joint, 1u);
  EXPECT_EQ(light.blockers[1].centre, human.light.blockers[1].centre);
  EXPECT_EQ(light.blockers[1].radius, human.light.blockers[1].radius);
  ASSERT_EQ(light.receivers.size(), 3u);
  EXPECT_EQ(light.receivers[2].joint, 1u);
  EXPECT_EQ(light.receivers[2].position, human.light.receivers[2].position);
  ASSERT_EQ(light.meshes.size(), 1u);
  EXPECT_EQ(light.meshes[0].receivers, human.light.meshes[0].receivers);
  EXPECT_EQ(light.meshes[0].weights, human.light.meshes[0].weights);
  EXPECT_EQ(light.meshes[0].coefficients, human.light.meshes[0].coefficients);
  EXPECT_EQ(light.meshes[0].scale, human.light.meshes[0].scale);
  ASSERT_FALSE(human.light.meshes[0].backs.empty());
  EXPECT_EQ(light.meshes[0].backs, human.light.meshes[0].backs);
}

// A human with a coarser level that leaves out the last vertex.
Human WithACoarserLevel() {
  Human human = RichHuman();
  human.meshes[0].coarser = {{0.01f, {0, 1, 2}}, {0.5f, {}}};
  return human;
}

TEST(HumanFile, WithoutFinerLevelsItSaysHowFarItIsFromTheFullDetail) {
  const float error = 0.01f * ErrorShare(Surface::kCloth);
  const auto coarse = ParseHuman(SerializeHuman(WithACoarserLevel()), "here", error);
  ASSERT_TRUE(coarse.ok()) << coarse.message();
  const auto again = ParseHuman(SerializeHuman(*coarse), "here");
  ASSERT_TRUE(again.ok()) << again.message();
  EXPECT_EQ(again->meshes[0].error, 0.01f);
  EXPECT_EQ(again->meshes[0].positions, coarse->meshes[0].positions);
  EXPECT_EQ(again->meshes[0].coarser.size(), 1u);
  EXPECT_EQ(again->light.meshes[0].coefficients, coarse->light.meshes[0].coefficients);
}

TEST(HumanFile, ReadsOnlyTheDetailThatIsWanted) {
  const Human human = WithACoarserLevel();
  const float error = 0.01f * ErrorShare(Surface::kCloth);
  const auto parsed = ParseHuman(SerializeHuman(human), "here", error);
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  const SkinnedMesh& all = human.meshes[0];
  const SkinnedMesh& mesh = parsed->meshes[0];
  const auto first = [](const auto& of, size_t count) {
    return std::decay_t<decltype(of)>(of.begin(), of.begin() + static_cast<ptrdiff_t>(count));
  };
  EXPECT_EQ(mesh.error, 0.01f);
  EXPECT_EQ(mesh.indices, all.coarser[0].indices);
  ASSERT_EQ(mesh.coarser.size(), 1u);
  EXPECT_EQ(mesh.coarser[0].error, 0.5f);
  EXPECT_EQ(mesh.positions, first(all.positions, 3));
  EXPECT_EQ(mesh.normals, first(all.normals, 3));
  EXPECT_EQ(mesh.albedo, first(all.albedo, 3));
  EXPECT_EQ(mesh.uvs, first(all.uvs, 3));
  EXPECT_EQ(mesh.joints, first(all.joints, 3));
  EXPECT_EQ(mesh.weights, first(all.weights, 3));
  const MorphTarget::Part& morph = parsed->morphs[0].parts[0];
  EXPECT_EQ(morph.vertices, (std::vector<uint32_t>{1}));
  EXPECT_EQ(morph.position_deltas, first(human.morphs[0].parts[0].position_deltas, 1));
  EXPECT_EQ(morph.normal_deltas, first(human.morphs[0].parts[0].normal_deltas, 1));
  EXPECT_EQ(parsed->cloths[0].positions, human.cloths[0].positions);
  EXPECT_EQ(parsed->cloths[0].vertex_triangle, first(human.cloths[0].vertex_triangle, 3));
  EXPECT_EQ(parsed->cloths[0].vertex_weights, first(human.cloths[0].vertex_weights, 3));
  const LightTransfer::Mesh& all_light = human.light.meshes[0];
  const LightTransfer::Mesh& light = parsed->light.meshes[0];
  EXPECT_EQ(light.receivers, first(all_light.receivers, 3));
  EXPECT_EQ(light.weights, first(all_light.weights, 3));
  EXPECT_EQ(light.backs, first(all_light.backs, 3));
  constexpr size_t kVector = 3 * 9;
  ASSERT_EQ(light.scale.size(), 2u * 3u);
  ASSERT_EQ(light.coefficients.size(), 2u * 3u * kVector);
  for (size_t pose = 0; pose < 2; ++pose) {
    for (size_t v = 0; v < 3; ++v) {
      EXPECT_EQ(light.scale[3 * pose + v], all_light.scale[4 * pose + v]);
      for (size_t k = 0; k < kVector; ++k) {
        EXPECT_EQ(light.coefficients[(3 * pose + v) * kVector + k],
                  all_light.coefficients[(4 * pose + v) * kVector + k]);
      }
    }
  }
}

TEST(HumanFile, ReadsAllWhereNoCoarserLevelWillDo) {
  const Human human = WithACoarserLevel();
  for (const float finest : {0.0f, 0.009f * ErrorShare(Surface::kCloth)}) {
    const auto parsed = ParseHuman(SerializeHuman(human), "here", finest);
    ASSERT_TRUE(parsed.ok()) << parsed.message();
    EXPECT_EQ(SerializeHuman(*parsed), SerializeHuman(human)) << finest;
  }
}

TEST(HumanFile, AHumanWithoutLightTransferHasNone) {
  const auto parsed = ParseHuman(SerializeHuman(TwoJointHuman()), "here");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_TRUE(parsed->light.empty());
}

TEST(HumanFile, TheSameHumanGivesTheSameBytes) {
  EXPECT_EQ(SerializeHuman(RichHuman()), SerializeHuman(RichHuman()));
}

TEST(HumanFile, SavesAndLoads) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "a.larhuman", SerializeHuman(TwoJointHuman())).ok());
  EXPECT_TRUE(LoadHuman(folder / "a.larhuman").ok());
  EXPECT_FALSE(LoadHuman(folder / "b.larhuman").ok());
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
  const auto refuses_texture = [&](auto&& change) {
    return refuses([&](Human& h) {
      Texture texture = *h.textures[0];
      change(texture);
      h.textures[0] = std::make_shared<const Texture>(std::move(texture));
    });
  };
  EXPECT_TRUE(refuses_texture([](Texture& t) { t.encoded[0] = std::byte{'G'}; }));
  EXPECT_TRUE(refuses_texture([](Texture& t) { t.encoded.clear(); }));
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

TEST(HumanFile, RefusesLightTransferThatCannotBe) {
  const auto refuses = [](auto&& change) {
    Human human = RichHuman();
    change(human.light);
    const auto parsed = ParseHuman(SerializeHuman(human), "here");
    return !parsed.ok() && parsed.message().find("light") != std::string::npos;
  };
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.count = 10; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.count = 16; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.key_poses.clear(); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.key_poses.pop_back(); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.key_poses.resize(9, l.key_poses[0]); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.key_poses[1].pop_back(); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.key_poses[1][0].translation.y = NAN; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.key_poses[0][1].rotation.w = 3.0f; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.blockers[0].joint = 2; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.blockers[0].radius = -0.1f; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.blockers[0].centre.z = INFINITY; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.blockers.resize(257); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.receivers.clear(); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.receivers.resize(1025); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.receivers[1].joint = 0x80000000u; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.receivers[1].position.x = NAN; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes.push_back(l.meshes[0]); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes[0].receivers[3][3] = 3; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes[0].receivers.pop_back(); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes[0].weights[0] = {254, 0, 0, 0}; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes[0].weights[0] = {55, 200, 0, 0}; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes[0].coefficients.pop_back(); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes[0].scale[7] = -1.0f; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes[0].scale[0] = NAN; }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes[0].scale.push_back(0.0f); }));
  EXPECT_TRUE(refuses([](LightTransfer& l) { l.meshes[0].backs.pop_back(); }));
}

TEST(HumanFile, RefusesEveryTruncation) {
  const std::vector<std::byte> bytes = SerializeHuman(RichHuman());
  for (size_t length = 0; length < bytes.size(); ++length) {
    // A copy of its own size, so that sanitizers see any read beyond it.
    const std::vector<std::byte> cut(bytes.begin(), bytes.begin() + static_cast<long>(length));
    EXPECT_FALSE(ParseHuman(cut, "cut").ok()) << length;
    EXPECT_FALSE(ParseHuman(cut, "cut", 1.0f).ok()) << length;
  }
}

TEST(HumanFile, SurvivesFlippedBits) {
  const std::vector<std::byte> bytes = SerializeHuman(WithACoarserLevel());
  Random random(3);
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::byte> damaged = bytes;
    for (uint32_t flips = 1 + random.Below(4); flips > 0; --flips) {
      damaged[random.Below(static_cast<uint32_t>(damaged.size()))] ^=
          static_cast<std::byte>(1u << random.Below(8));
    }
    for (const float finest : {0.0f, 0.006f}) {
      const auto parsed = ParseHuman(damaged, "damaged", finest);
      if (parsed.ok()) {
        EXPECT_TRUE(parsed->Validate("damaged").ok());
      }
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
