#include "shared/stage/prop.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/stage/test_props.h"

namespace lararium::stage {
namespace {

Prop MakeRich() {
  Prop prop = test::MakeChest();
  prop.credits = "by us";
  prop.textures.push_back(
      {"wood", {std::byte{0x89}, std::byte{'P'}, std::byte{'N'}, std::byte{'G'}}});
  human::Material material;
  material.name = "wood";
  material.colour_texture = 0;
  material.roughness = 0.4f;
  prop.materials.push_back(material);
  prop.parts[0].meshes[0].material = 0;
  prop.parts[0].meshes[0].uvs.resize(8, {0.25f, 0.75f});
  prop.parts[1].meshes[0].emission = {3.0f, 2.0f, 1.0f};
  return prop;
}

TEST(Prop, RoundTrips) {
  const Prop prop = MakeRich();
  const std::vector<std::byte> bytes = SerializeProp(prop);
  const auto parsed = ParseProp(bytes, "a.larprop");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(SerializeProp(*parsed), bytes);
  EXPECT_EQ(parsed->use, prop.use);
  EXPECT_EQ(parsed->parts[1].parent, 0);
  EXPECT_EQ(parsed->parts[1].parent_from_part, prop.parts[1].parent_from_part);
  EXPECT_EQ(parsed->parts[0].meshes[0].positions, prop.parts[0].meshes[0].positions);
  EXPECT_EQ(parsed->parts[0].meshes[0].uvs, prop.parts[0].meshes[0].uvs);
  EXPECT_EQ(parsed->parts[1].meshes[0].emission, prop.parts[1].meshes[0].emission);
  EXPECT_EQ(parsed->materials[0].roughness, 0.4f);
  EXPECT_EQ(parsed->textures[0].encoded, prop.textures[0].encoded);
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
  EXPECT_NE(error([](Prop& p) { p.parts[0].meshes[0].material = 1; }).find("material"),
            std::string::npos);
  EXPECT_NE(error([](Prop& p) { p.parts[0].meshes[0].emission.x = -1.0f; }).find("emission"),
            std::string::npos);
  EXPECT_NE(error([](Prop& p) {
              p.parts[0].parent_from_part.rotation.w = std::numeric_limits<float>::quiet_NaN();
            }).find("rigid"),
            std::string::npos);
  EXPECT_NE(error([](Prop& p) { p.parts.clear(); }).find("parts"), std::string::npos);
}

}  // namespace
}  // namespace lararium::stage
