#include "editor/document/cast_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/jobs/bone_review.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

TEST(CastDocument, KeepsBonesNamedByHand) {
  CastDocument member;
  member.name = "guest";
  member.model = "guest.glb";
  member.bones = {{"l_hip", "Bone.1"}, {"r_thumb1", ""}};
  const Json json = FormatFields(member);
  const Result<CastDocument> read = ParseFields<CastDocument>(JsonView(json, "project.json"));
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(read->bones, member.bones);
}

TEST(CastDocument, RefusesJointsThatPeopleHaveNot) {
  const Json json = {{"name", "guest"}, {"model", "guest.glb"}, {"bones", {{"l_wing", "Bone"}}}};
  const Result<CastDocument> read = ParseFields<CastDocument>(JsonView(json, "project.json"));
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.message(), HasSubstr("l_wing"));
}

TEST(ChooseBone, TakesTheBoneFromTheJointThatHadIt) {
  CastDocument member;
  ChooseBone("l_hip", "Bone.1", member);
  ChooseBone("r_hip", "Bone.1", member);
  EXPECT_THAT(member.bones, ElementsAre(Pair("r_hip", "Bone.1")));
  ChooseBone("l_knee", "", member);
  ChooseBone("r_knee", "", member);  // Both joints can be missing.
  EXPECT_EQ(member.bones.size(), 3u);
  ChooseBone("r_hip", std::nullopt, member);
  EXPECT_FALSE(member.bones.contains("r_hip"));
}

TEST(GivenBoneNames, ByHandGoesOverTheSavedMap) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "bones.json";
  ASSERT_TRUE(import::SaveBoneNames(file, {{"l_hip", "A"}, {"r_hip", "B"}}).ok());
  const auto given = GivenBoneNames(file, {{"l_knee", "A"}, {"r_hip", "C"}});
  ASSERT_TRUE(given.ok()) << given.message();
  EXPECT_THAT(*given, ElementsAre(Pair("l_knee", "A"), Pair("r_hip", "C")));
}

}  // namespace
}  // namespace lararium::editor
