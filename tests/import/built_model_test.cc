#include "editor/import/model/built_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shared/core/random.h"
#include "tests/import/plain_figure.h"

namespace lararium::import {
namespace {

using ::testing::HasSubstr;

BuiltModel Built() {
  BuiltModel model;
  model.human.name = "Felix";
  model.human.skeleton = PlainSkeleton();
  model.human.materials = {{.name = "skin"}};
  model.images = {{"skin.png", {std::byte{1}, std::byte{2}, std::byte{3}}}};
  model.uses = {{.colour = 0}};
  model.emissions = {{2.0f, 0.5f, 0.0f}};
  model.bones = {{"l_elbow", "LeftForeArm"}};
  model.is_human = true;
  model.bone_table = "l_elbow LeftForeArm";
  model.joints = {{"l_elbow", "LeftForeArm", FoundBy::kStructure, 0.25f}};
  model.bone_names = {"Hips", "LeftForeArm"};
  model.notes = {"its feet point backwards"};
  return model;
}

std::vector<std::byte> Packed(const BuiltModel& model) { return PackModel(model).value(); }

TEST(BuiltModel, ComesBackFromAnotherProcessAsItWas) {
  const BuiltModel sent = Built();
  const auto got = UnpackModel(Packed(sent), "a.glb");
  ASSERT_TRUE(got.ok()) << got.message();
  EXPECT_EQ(human::SerializeHuman(got->human), human::SerializeHuman(sent.human));
  ASSERT_EQ(got->images.size(), 1u);
  EXPECT_EQ(got->images[0].name, "skin.png");
  EXPECT_EQ(got->images[0].encoded, sent.images[0].encoded);
  ASSERT_EQ(got->uses.size(), 1u);
  EXPECT_EQ(got->uses[0].colour, 0);
  EXPECT_EQ(got->uses[0].normal, -1);
  EXPECT_EQ(got->emissions, sent.emissions);
  EXPECT_EQ(got->bones, sent.bones);
  EXPECT_TRUE(got->is_human);
  EXPECT_EQ(got->bone_table, sent.bone_table);
  ASSERT_EQ(got->joints.size(), 1u);
  EXPECT_EQ(got->joints[0].bone, "LeftForeArm");
  EXPECT_EQ(got->joints[0].found_by, FoundBy::kStructure);
  EXPECT_EQ(got->joints[0].confidence, 0.25f);
  EXPECT_EQ(got->bone_names, sent.bone_names);
  EXPECT_EQ(got->notes, sent.notes);
}

TEST(BuiltModel, IsRefusedWhereItUsesImagesThatItLacks) {
  for (const TextureUse& use : {TextureUse{.colour = 1}, TextureUse{.normal = 1}}) {
    BuiltModel model = Built();
    model.uses = {use};
    EXPECT_EQ(UnpackModel(Packed(model), "a.glb").message(),
              "a.glb: its reader returned invalid data");
  }
  BuiltModel without_uses = Built();
  without_uses.uses.clear();  // Fewer than materials.
  BuiltModel without_emissions = Built();
  without_emissions.emissions.clear();
  for (const BuiltModel& model : {without_uses, without_emissions}) {
    EXPECT_EQ(UnpackModel(Packed(model), "a.glb").message(),
              "a.glb: its reader returned invalid data");
  }
}

TEST(BuiltModel, IsRefusedWhereAPieceOfItsFigureIsMissing) {
  const std::vector<std::byte> whole = Packed(Built());
  const size_t without_image = whole.size() - sizeof(uint64_t) - 3;
  for (size_t size = 0; size < without_image; size += 37) {
    const auto got = UnpackModel(std::span(whole).first(size), "a.glb");
    ASSERT_FALSE(got.ok()) << size;
    EXPECT_THAT(got.message(), HasSubstr("a.glb")) << size;
  }
}

TEST(BuiltModel, StandsAnyDamage) {
  const std::vector<std::byte> whole = Packed(Built());
  Random random(23);
  for (int trial = 0; trial < 500; ++trial) {
    std::vector<std::byte> bytes = whole;
    for (int flips = 0; flips < 4; ++flips) {
      bytes[random.Below(static_cast<uint32_t>(bytes.size()))] ^=
          static_cast<std::byte>(1u << random.Below(8));
    }
    const auto got = UnpackModel(bytes, "a.glb");
    EXPECT_TRUE(!got.ok() || got->uses.size() == got->human.materials.size());
  }
}

}  // namespace
}  // namespace lararium::import
