#include "shared/stage/prop.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/stage/test_props.h"

namespace lararium::stage {
namespace {

// A transfer with two key poses; in the second the lid is not shown.
void AddLight(Prop& prop) {
  human::LightTransfer& light = prop.light;
  light.count = 9;
  light.bounces = 2;
  light.key_poses.resize(2, std::vector<human::JointTransform>(2));
  light.key_poses[1][1].translation = {0.0f, 0.7f, 0.2f};
  light.key_poses[1][1].rotation = glm::angleAxis(0.5f, glm::vec3(1.0f, 0.0f, 0.0f));
  prop.light_shown = {3, 1};
  light.receivers = {{0, {0.0f, 0.8f, 0.0f}}, {1, {0.1f, 0.2f, 0.3f}}};
  for (size_t m = 0; m < 2; ++m) {
    human::LightTransfer::Mesh& mesh = light.meshes.emplace_back();
    mesh.receivers.assign(8, {static_cast<uint16_t>(m), 0, 0, 0});
    mesh.weights.assign(8, {200, 55, 0, 0});
    mesh.scale.assign(16, 0.25f);
    for (int i = 0; i < 16 * 3 * 9; ++i) {
      mesh.coefficients.push_back(static_cast<int8_t>(i % 251 - 125));
    }
  }
  light.meshes[1].backs.assign(8, {10, 20, 30});
}

Prop MakeRich() {
  Prop prop = test::MakeChest();
  prop.credits = "by us";
  prop.textures.push_back(std::make_shared<const human::Texture>(
      human::Texture{"wood", {std::byte{0x89}, std::byte{'P'}, std::byte{'N'}, std::byte{'G'}}}));
  human::Material material;
  material.name = "wood";
  material.colour_texture = 0;
  material.roughness = 0.4f;
  prop.materials.push_back(material);
  prop.parts[0].meshes[0].material = 0;
  prop.parts[0].meshes[0].uvs.resize(8, {0.25f, 0.75f});
  prop.parts[1].meshes[0].emission = {3.0f, 2.0f, 1.0f};
  prop.parts[1].meshes[0].coarser = {{0.01f, {0, 1, 2, 0, 2, 3}}, {0.05f, {0, 1, 2}}};
  AddLight(prop);
  return prop;
}

TEST(Prop, RoundTrips) {
  const Prop prop = MakeRich();
  const std::vector<std::byte> bytes = SerializeProp(prop);
  const auto parsed = ParseProp(bytes, "a.larprop");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(SerializeProp(*parsed), bytes);
  EXPECT_EQ(parsed->use, prop.use);
  ASSERT_EQ(parsed->parts[1].meshes[0].coarser.size(), 2u);
  EXPECT_EQ(parsed->parts[1].meshes[0].coarser[0].error, 0.01f);
  EXPECT_EQ(parsed->parts[1].meshes[0].coarser[1].indices, (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(parsed->parts[1].parent, 0);
  EXPECT_EQ(parsed->parts[1].parent_from_part, prop.parts[1].parent_from_part);
  EXPECT_EQ(parsed->parts[0].meshes[0].positions, prop.parts[0].meshes[0].positions);
  EXPECT_EQ(parsed->parts[0].meshes[0].uvs, prop.parts[0].meshes[0].uvs);
  EXPECT_EQ(parsed->parts[1].meshes[0].emission, prop.parts[1].meshes[0].emission);
  EXPECT_EQ(parsed->materials[0].roughness, 0.4f);
  EXPECT_EQ(*parsed->textures[0], *prop.textures[0]);
}

TEST(Prop, RoundTripKeepsTheLightTransfer) {
  const Prop prop = MakeRich();
  const auto parsed = ParseProp(SerializeProp(prop), "a.larprop");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->light.count, 9);
  EXPECT_EQ(parsed->light.bounces, 2);
  EXPECT_EQ(parsed->light_shown, prop.light_shown);
  ASSERT_EQ(parsed->light.key_poses.size(), 2u);
  EXPECT_EQ(parsed->light.key_poses[1][1].translation, prop.light.key_poses[1][1].translation);
  EXPECT_EQ(parsed->light.key_poses[1][1].rotation, prop.light.key_poses[1][1].rotation);
  ASSERT_EQ(parsed->light.receivers.size(), 2u);
  EXPECT_EQ(parsed->light.receivers[1].joint, 1u);
  EXPECT_EQ(parsed->light.receivers[1].position, prop.light.receivers[1].position);
  ASSERT_EQ(parsed->light.meshes.size(), 2u);
  EXPECT_EQ(parsed->light.meshes[1].receivers, prop.light.meshes[1].receivers);
  EXPECT_EQ(parsed->light.meshes[1].weights, prop.light.meshes[1].weights);
  EXPECT_EQ(parsed->light.meshes[1].coefficients, prop.light.meshes[1].coefficients);
  EXPECT_EQ(parsed->light.meshes[1].scale, prop.light.meshes[1].scale);
  EXPECT_TRUE(parsed->light.meshes[0].backs.empty());
  EXPECT_EQ(parsed->light.meshes[1].backs, prop.light.meshes[1].backs);
}

TEST(Prop, WithoutLightIsRead) {
  const auto parsed = ParseProp(SerializeProp(test::MakeChest()), "a.larprop");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_TRUE(parsed->light.empty());
}

TEST(Prop, RefusesEveryTruncation) {
  const std::vector<std::byte> bytes = SerializeProp(MakeRich());
  for (size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 37) {
    EXPECT_FALSE(
        ParseProp(std::vector(bytes.begin(), bytes.begin() + static_cast<long>(size)), "a.larprop")
            .ok())
        << size;
  }
}

TEST(Prop, SurvivesEveryChangedByte) {
  const std::vector<std::byte> bytes = SerializeProp(MakeRich());
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (const std::byte flip : {std::byte{1}, std::byte{0x80}, std::byte{0xff}}) {
      std::vector<std::byte> changed = bytes;
      changed[i] ^= flip;
      if (const auto parsed = ParseProp(changed, "a.larprop"); parsed.ok()) {
        EXPECT_TRUE(parsed->Validate("a.larprop").ok());
      }
    }
  }
}

TEST(Prop, SaysWhatIsWrong) {
  const auto error = [](const std::function<void(Prop&)>& spoil) {
    Prop prop = MakeRich();
    spoil(prop);
    const auto parsed = ParseProp(SerializeProp(prop), "a.larprop");
    return parsed.ok() ? "" : parsed.message();
  };
  EXPECT_NE(error([](Prop& p) { p.parts[1].parent = 1; }).find("must be an earlier part"),
            std::string::npos);
  EXPECT_NE(error([](Prop& p) { p.parts[1].name = "body"; }).find("two parts"), std::string::npos);
  EXPECT_NE(error([](Prop& p) { p.parts[0].meshes[0].indices[2] = 8; }).find("do not exist"),
            std::string::npos);
  EXPECT_NE(
      error([](Prop& p) { p.parts[1].meshes[0].coarser[1].indices[2] = 8; }).find("do not exist"),
      std::string::npos);
  EXPECT_NE(error([](Prop& p) {
              p.parts[1].meshes[0].coarser[0].error = -1.0f;
            }).find("invalid error value"),
            std::string::npos);
  EXPECT_NE(error([](Prop& p) { p.parts[0].meshes[0].material = 1; }).find("material"),
            std::string::npos);
  EXPECT_NE(error([](Prop& p) { p.parts[0].meshes[0].emission.x = -1.0f; }).find("emission"),
            std::string::npos);
  EXPECT_NE(error([](Prop& p) {
              p.parts[0].parent_from_part.rotation.w = std::numeric_limits<float>::quiet_NaN();
            }).find("rigid"),
            std::string::npos);
  EXPECT_NE(error([](Prop& p) { p.parts.clear(); }).find("parts"), std::string::npos);
  EXPECT_NE(error([](Prop& p) { p.light.meshes[1].scale.pop_back(); }).find("does not fit"),
            std::string::npos);
  EXPECT_NE(error([](Prop& p) { p.light.receivers[1].joint = 2; }).find("receiver"),
            std::string::npos);
}

}  // namespace
}  // namespace lararium::stage
