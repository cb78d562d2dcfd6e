#include "shared/show/lost_guide.h"

#include <gtest/gtest.h>

#include "shared/core/utf8.h"
#include "shared/show/guide_texts.h"

namespace lararium::show {
namespace {

// Keyframes that look along +Z from x = 0, 1, 2, ..., each with a number of observed points.
vision::SceneDatabase Map(const std::vector<uint32_t>& observations) {
  vision::SceneDatabase map;
  for (uint32_t i = 0; i < observations.size(); ++i) {
    vision::Keyframe& keyframe = map.keyframes.emplace_back();
    keyframe.camera_from_map.translation = {-static_cast<double>(i), 0.0, 0.0};
    keyframe.grey = cv::Mat(48, 64, CV_8UC1, cv::Scalar(10.0 * (i + 1)));
    for (uint32_t k = 0; k < observations[i]; ++k) {
      map.observations.push_back({0, i, 1.0f, 1.0f, 1.0f});
    }
  }
  map.points = {{0.0f, 0.0f, 4.0f}};
  return map;
}

geometry::Rigid3 PoseAt(double x) { return {Eigen::Quaterniond::Identity(), {-x, 0.0, 0.0}}; }

vision::TrackedFrame Tracked(std::optional<geometry::Rigid3> pose) {
  vision::TrackedFrame frame;
  frame.camera_from_map = pose;
  frame.reason = pose ? vision::TrackReason::kNone : vision::TrackReason::kTooFewMatches;
  return frame;
}

TEST(ChooseGuideView, IsTheNearestOfThoseThatAreFoundWell) {
  const vision::SceneDatabase map = Map({100, 10, 90, 100});
  EXPECT_EQ(ChooseGuideView(map, PoseAt(0.2)), 0u);
  EXPECT_EQ(ChooseGuideView(map, PoseAt(1.2)), 2u) << "the nearest sees too little";
  EXPECT_EQ(ChooseGuideView(map, PoseAt(9.0)), 3u);
}

TEST(ChooseGuideView, WhoLooksElsewhereIsShownWhereTheyLookedLast) {
  vision::SceneDatabase map = Map({100, 100});
  map.keyframes[0].camera_from_map.rotation =
      geometry::RotationFromVector(Eigen::Vector3d(0.0, 1.5, 0.0));
  geometry::Rigid3 last = PoseAt(0.4);
  last.rotation = geometry::RotationFromVector(Eigen::Vector3d(0.0, 1.3, 0.0));
  EXPECT_EQ(ChooseGuideView(map, last), 0u);
}

TEST(ChooseGuideView, WithoutALastPoseIsTheRichestAndWithoutImagesNone) {
  vision::SceneDatabase map = Map({10, 100, 30});
  EXPECT_EQ(ChooseGuideView(map, std::nullopt), 1u);
  map.keyframes[1].grey.release();
  EXPECT_EQ(ChooseGuideView(map, std::nullopt), 2u);
  for (vision::Keyframe& keyframe : map.keyframes) {
    keyframe.grey.release();
  }
  EXPECT_EQ(ChooseGuideView(map, PoseAt(0.0)), std::nullopt);
  EXPECT_EQ(ChooseGuideView(vision::SceneDatabase(), PoseAt(0.0)), std::nullopt);
}

TEST(LostGuide, ShowsOnePictureForEachLoss) {
  const vision::SceneDatabase map = Map({100, 100, 100});
  LostGuide guide;
  StagedGuide shown;
  guide.Update(0.0f, Tracked(PoseAt(2.1)), &map, shown);
  EXPECT_TRUE(shown.picture.empty());
  guide.Update(0.1f, Tracked(std::nullopt), &map, shown);
  ASSERT_FALSE(shown.picture.empty());
  EXPECT_EQ(shown.picture.at<uchar>(5, 5), 30);
  const uint64_t number = shown.picture_number;
  guide.Update(1.0f, Tracked(std::nullopt), &map, shown);
  EXPECT_EQ(shown.picture_number, number);
  guide.Update(0.5f, Tracked(PoseAt(0.1)), &map, shown);
  EXPECT_EQ(shown.picture.at<uchar>(5, 5), 30) << "it does not change while it goes";
  guide.Update(0.0f, Tracked(PoseAt(0.1)), &map, shown);
  guide.Update(0.1f, Tracked(std::nullopt), &map, shown);
  EXPECT_EQ(shown.picture.at<uchar>(5, 5), 10);
  EXPECT_GT(shown.picture_number, number);
}

TEST(LostGuide, SaysWhenTheCameraSeesNothing) {
  const vision::SceneDatabase map = Map({100});
  LostGuide guide;
  StagedGuide shown;
  vision::TrackedFrame dark = Tracked(std::nullopt);
  dark.reason = vision::TrackReason::kTooDark;
  guide.Update(0.5f, dark, &map, shown);
  EXPECT_EQ(shown.says, StagedGuide::Says::kDark);
  guide.Update(0.6f, Tracked(std::nullopt), &map, shown);
  EXPECT_EQ(shown.says, StagedGuide::Says::kLookThere);
}

TEST(LostGuide, NeedsNoMap) {
  LostGuide guide;
  StagedGuide shown;
  guide.Update(1.0f, Tracked(std::nullopt), nullptr, shown);
  EXPECT_TRUE(shown.picture.empty());
  EXPECT_EQ(shown.opacity, 1.0f);
}

render::CaptionFont Letters(std::string_view text) {
  render::CaptionFont font;
  for (size_t at = 0; at < text.size();) {
    font.glyphs.push_back({NextCharacter(text, at), 0.5f});
  }
  std::sort(font.glyphs.begin(), font.glyphs.end(),
            [](const auto& a, const auto& b) { return a.character < b.character; });
  return font;
}

TEST(BuiltInGuide, IsInTheLanguageWhereTheFontHasItsLetters) {
  std::string ascii;
  for (char c = ' '; c <= '~'; ++c) {
    ascii += c;
  }
  const render::CaptionFont plain = Letters(ascii);
  const render::CaptionFont accented = Letters(ascii + "éÈÎîô");
  const std::string english = BuiltInGuide("en", &plain).look;
  EXPECT_NE(BuiltInGuide("la", &plain).look, english);
  EXPECT_NE(BuiltInGuide("de", &plain).look, english);
  EXPECT_EQ(BuiltInGuide("fr", &plain).look, english);
  EXPECT_NE(BuiltInGuide("fr-CH", &accented).look, english);
  EXPECT_EQ(BuiltInGuide("xx", &plain).look, english);
  EXPECT_EQ(BuiltInGuide("", &plain).look, english);
  for (const char* language : {"en", "la", "de", "nl"}) {
    EXPECT_TRUE(CanWrite(plain, BuiltInGuide(language, &plain).look)) << language;
    EXPECT_TRUE(CanWrite(plain, BuiltInGuide(language, &plain).dark)) << language;
    EXPECT_TRUE(CanWrite(plain, BuiltInGuide(language, &plain).farewell)) << language;
  }
}

}  // namespace
}  // namespace lararium::show
