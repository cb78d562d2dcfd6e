#include "shared/show/show_captions.h"

#include <gmock/gmock.h>

#include <glm/gtc/matrix_transform.hpp>

namespace lararium::show {
namespace {

using render::CaptionSide;

CaptionTexts Texts() {
  CaptionTexts texts;
  texts.lines = {{{0.0, 1.0, "first"}, {1.5, 3.0, "second"}}, {{0.0, 9.0, "other"}}, {}};
  texts.speakers = {"Placidus", "Ascula", "Girl"};
  return texts;
}

TEST(ShowCaptions, ACueIsThereFromItsBeginningUntilItsEnd) {
  const CaptionTexts texts = Texts();
  EXPECT_EQ(FindCue(texts.lines[0], 0.0)->text, "first");
  EXPECT_EQ(FindCue(texts.lines[0], 1.0), nullptr);
  EXPECT_EQ(FindCue(texts.lines[0], 1.5)->text, "second");
  EXPECT_EQ(FindCue(texts.lines[0], 3.0), nullptr);
  EXPECT_EQ(FindCue(texts.lines[2], 0.0), nullptr);
}

TEST(ShowCaptions, TheTwoThatBeganLastAreShownTheNewestFirst) {
  StagedFrame staged;
  staged.lines = {{0, 1, 5.0, true}, {1, 0, 0.5, true}, {2, 1, 2.0, false}, {0, 2, 0.1, true}};
  std::vector<render::Caption> captions;
  CollectCaptions(Texts(), staged, captions);
  ASSERT_EQ(captions.size(), 2u);
  EXPECT_EQ(captions[0].speaker, "Ascula");
  EXPECT_EQ(captions[0].text, "first");
  EXPECT_EQ(captions[1].speaker, "Girl");
  EXPECT_NE(captions[0].colour, captions[1].colour);
  // Two lines that began in the same tick are both shown.
  staged.lines = {{0, 1, 0.5, true}, {1, 0, 0.5, true}};
  CollectCaptions(Texts(), staged, captions);
  EXPECT_EQ(captions.size(), 2u);
  staged.lines.clear();
  CollectCaptions(Texts(), staged, captions);
  EXPECT_TRUE(captions.empty());
}

TEST(ShowCaptions, WhatNobodySaysHasNoNameAndStaysAsLongAsItIsShown) {
  StagedFrame staged;
  staged.lines = {{StagedLine::kNobody, 0, 1.2, false}};
  std::vector<render::Caption> captions;
  CollectCaptions(Texts(), staged, captions);
  ASSERT_EQ(captions.size(), 1u);
  EXPECT_TRUE(captions[0].speaker.empty());
  EXPECT_EQ(captions[0].text, "second") << "what comes next is read ahead of its time";
  staged.lines[0].seconds = 50.0;
  CollectCaptions(Texts(), staged, captions);
  ASSERT_EQ(captions.size(), 1u);
  EXPECT_EQ(captions[0].text, "second");
}

TEST(ShowCaptions, WhatIsDescribedIsInBracketsAndHasNoName) {
  ShowContent content;
  content.speech = {{.name = "salvete", .visemes = {}, .captions = {{0.0, 1.0, "Greetings!"}}},
                    {.name = "d_bar",
                     .visemes = {},
                     .captions = {{0.0, 2.0, "A bar\nat dawn."}},
                     .describes = true}};
  StagedFrame staged;
  staged.lines = {{StagedLine::kDescription, 1, 0.5, true}};
  std::vector<render::Caption> captions;
  const CaptionTexts texts = TextsOf(content);
  CollectCaptions(texts, staged, captions);
  ASSERT_EQ(captions.size(), 1u);
  EXPECT_TRUE(captions[0].speaker.empty());
  EXPECT_EQ(captions[0].side, CaptionSide::kHere);
  EXPECT_EQ(captions[0].text, "[A bar\nat dawn.]");
  EXPECT_EQ(texts.lines[0][0].text, "Greetings!");
  staged.lines[0].seconds = 2.5;
  CollectCaptions(texts, staged, captions);
  EXPECT_TRUE(captions.empty()) << "it has a voice to follow";
}

TEST(ShowCaptions, AnArrowPointsToASpeakerOutOfView) {
  StagedFrame staged;
  staged.tracked.camera = {
      .width = 640, .height = 480, .fx = 500, .fy = 500, .cx = 319.5, .cy = 239.5};
  const auto side = [&](const glm::vec3& place) {
    staged.people.actors = {{}};
    staged.people.actors[0].cast = 1;
    staged.people.actors[0].stage_from_actor = glm::translate(glm::mat4(1.0f), place);
    return SideOf(staged, 1);
  };
  EXPECT_EQ(side({9.0f, 0.0f, 0.0f}), CaptionSide::kHere) << "nobody knows where the camera is";
  // Camera axes: x right, z forward.
  staged.camera.camera_from_stage.emplace();
  EXPECT_EQ(side({0.0f, 0.0f, 3.0f}), CaptionSide::kHere);
  EXPECT_EQ(side({-9.0f, 0.0f, 3.0f}), CaptionSide::kLeft);
  EXPECT_EQ(side({9.0f, 0.0f, 3.0f}), CaptionSide::kRight);
  EXPECT_EQ(side({-0.5f, 0.0f, -3.0f}), CaptionSide::kLeft) << "behind";
  EXPECT_EQ(SideOf(staged, 0), CaptionSide::kHere) << "hidden";
}

}  // namespace
}  // namespace lararium::show
