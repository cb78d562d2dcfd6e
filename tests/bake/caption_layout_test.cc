#include "editor/bake/caption_layout.h"

#include <gmock/gmock.h>

namespace lararium::bake {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

human::VisemeTrack Track(float duration) {
  human::VisemeTrack track;
  track.duration = duration;
  track.keys = {{0.0f, human::Viseme::kAa, 1.0f}};
  return track;
}

TEST(CaptionLayout, CountsLettersAndNotBytesOrAccents) {
  EXPECT_EQ(CountLetters("Salvēte"), 7u);
  EXPECT_EQ(CountLetters("Salve\xCC\x84te"), 7u) << "a combining macron";
  EXPECT_EQ(CountLetters("Χαῖρε"), 5u);
}

TEST(CaptionLayout, ShortTextsAreOneRow) {
  EXPECT_THAT(BreakRows("  Bene   olet! ", {}), ElementsAre("Bene olet!"));
  EXPECT_THAT(BreakRows("", {}), SizeIs(0));
}

TEST(CaptionLayout, RowsAreEvenAndRatherBreakAfterPunctuation) {
  EXPECT_THAT(BreakRows("I have waited since the morning, but the wine is not warm yet.", {}),
              ElementsAre("I have waited since the morning,", "but the wine is not warm yet."));
  for (const std::string& row :
       BreakRows(std::string(40, 'x') + " of the wine and of the bread "
                                        "that my mother baked before the sun rose",
                 {})) {
    EXPECT_LE(CountLetters(row), 42u);
  }
}

TEST(CaptionLayout, AWordThatIsLongerThanARowIsKept) {
  const std::string word(60, 'a');
  EXPECT_THAT(BreakRows("to " + word, {}), ElementsAre("to", word));
}

TEST(CaptionLayout, CaptionsHaveTwoRowsAtMostAndFollowOneAnother) {
  std::string text;
  for (int i = 0; i < 12; ++i) {
    text += "These words are said, and then some more. ";
  }
  const auto cues = LayOutCaptions(text, Track(30.0f));
  ASSERT_GE(cues.size(), 3u);
  EXPECT_TRUE(stage::CheckCues(cues, "cues").ok());
  EXPECT_EQ(cues.front().begin, 0.0);
  EXPECT_GE(cues.back().end, 30.0);
  for (size_t i = 1; i < cues.size(); ++i) {
    EXPECT_EQ(cues[i].begin, cues[i - 1].end);
  }
}

TEST(CaptionLayout, WhatIsSaidFastStaysToBeRead) {
  const auto cues = LayOutCaptions("I want warm wine and some bread.", Track(0.5f));
  ASSERT_THAT(cues, SizeIs(1));
  EXPECT_NEAR(cues[0].end, 32.0 / 17.0, 1e-3);
  EXPECT_NEAR(LayOutCaptions("Yes.", Track(0.3f))[0].end, 1.0, 1e-9);
  EXPECT_LT(ReadingSpeed(cues), 17.01);
}

TEST(CaptionLayout, CaptionsChangeInThePauseOfTheVoice) {
  human::VisemeTrack track = Track(6.0f);
  track.keys.push_back({2.6f, human::Viseme::kSil, 1.0f});
  track.keys.push_back({2.9f, human::Viseme::kAa, 1.0f});
  const auto cues = LayOutCaptions(
      "They came to the bar in the morning and they drank. "
      "Then they all went home to their wives and their children again.",
      track, {.letters = 36});
  ASSERT_GE(cues.size(), 2u);
  EXPECT_NEAR(cues[0].end, 2.75, 1e-6);
}

}  // namespace
}  // namespace lararium::bake
