#include "editor/document/cast_edits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lararium::editor {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

CastDocument Ada() {
  CastDocument ada;
  ada.name = "ada";
  ada.clips = {{"wave", "motions/wave.bvh", false}, {"dance", "motions/dance.bvh", true}};
  return ada;
}

Json Clips(const CastDocument& member) { return FormatFields(member)["clips"]; }

TEST(CastEdits, AClipIsRenamedInItsPlaceAndKeepsTheRest) {
  CastDocument ada = Ada();
  Json expected = Clips(ada);
  expected[0]["name"] = "hail";
  ASSERT_TRUE(RenameClip("wave", "hail", ada).ok());
  EXPECT_EQ(Clips(ada), expected);
  EXPECT_TRUE(RenameClip("hail", "hail", ada).ok()) << "as it is called";
  EXPECT_EQ(Clips(ada), expected);
}

TEST(CastEdits, AClipThatIsAddedTakesThePlaceOfOneOfItsName) {
  CastDocument ada = Ada();
  ASSERT_TRUE(AddClip({"wave", "other.bvh", true}, ada).ok());
  ASSERT_EQ(ada.clips.size(), 2u);
  EXPECT_EQ(ada.clips.back().file, "other.bvh");
  ASSERT_TRUE(RemoveClip("wave", ada).ok());
  ASSERT_EQ(ada.clips.size(), 1u);
  EXPECT_EQ(ada.clips.front().name, "dance");
}

TEST(CastEdits, WhatCannotBeIsRefusedAndChangesNothing) {
  CastDocument ada = Ada();
  EXPECT_THAT(RenameClip("wave", "dance", ada).message(), HasSubstr("\"dance\" already"));
  EXPECT_THAT(RenameClip("wave", "a name", ada).message(),
              HasSubstr("\"a name\" is not a valid name"));
  EXPECT_THAT(RenameClip("jump", "leap", ada).message(), HasSubstr("it has wave, dance"));
  EXPECT_THAT(RemoveClip("jump", ada).message(), HasSubstr("\"jump\""));
  EXPECT_THAT(AddClip({"", "wave.bvh", false}, ada).message(), HasSubstr("is not a valid name"));
  EXPECT_EQ(Clips(ada), Clips(Ada()));
}

TEST(LinesThatSay, FindsTextsHoweverTheyAreQuotedAndNoComments) {
  const std::string script =
      "track{ actor = \"ada\",\n"
      "  clips = { {at = 1, clip = \"wave\"}, {at = 2, clip = 'wave'} },\n"
      "}\n"
      "-- ada:play(\"wave\")\n"
      "ada:play [[wave]]\n"
      "wave = \"waves\"\n";
  EXPECT_THAT(LinesThatSay(script, "wave"), ElementsAre(2u, 5u));
  EXPECT_THAT(LinesThatSay(script, "jump"), IsEmpty());
}

}  // namespace
}  // namespace lararium::editor
