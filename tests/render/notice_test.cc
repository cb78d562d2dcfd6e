#include "shared/render/text/notice.h"

#include <gtest/gtest.h>

namespace lararium::render {
namespace {

CaptionFont Letters() {
  CaptionFont font;
  font.em_px = 32.0f;
  font.rim_px = 4.0f;
  for (uint32_t c = 'a'; c <= 'z'; ++c) {
    font.glyphs.push_back({c, 0.5f});
  }
  return font;
}

bool IsWithin(const NoticeLayout& layout, int width, int height) {
  return layout.from.x >= 0.0f && layout.from.y >= 0.0f &&
         layout.to.x <= static_cast<float>(width) && layout.to.y <= static_cast<float>(height);
}

TEST(Notice, LiesInTheMiddleAndHoldsItsPictureAndItsWords) {
  const CaptionFont font = Letters();
  Notice notice;
  notice.text = "look here\nplease";
  notice.picture = cv::Mat(240, 320, CV_8UC1, cv::Scalar(0));
  for (const auto& [width, height] : {std::pair(640, 480), {1280, 720}, {320, 240}, {480, 800}}) {
    const NoticeLayout layout = LayOut(font, notice, width, height);
    EXPECT_TRUE(IsWithin(layout, width, height)) << width;
    EXPECT_NEAR(0.5f * (layout.from.x + layout.to.x), 0.5f * static_cast<float>(width), 2.0f);
    EXPECT_NEAR(0.5f * (layout.from.y + layout.to.y), 0.5f * static_cast<float>(height), 2.0f);
    const glm::vec2 picture = layout.picture_to - layout.picture_from;
    EXPECT_NEAR(picture.x / picture.y, 320.0f / 240.0f, 1e-3f) << "nothing is stretched";
    EXPECT_GT(layout.picture_from.y, layout.from.y);
    EXPECT_GT(layout.first_baseline, layout.picture_to.y) << "words are below the picture";
    EXPECT_LT(layout.first_baseline + layout.em, layout.to.y);
  }
}

TEST(Notice, WordsAloneAndAPictureAloneAreSmaller) {
  const CaptionFont font = Letters();
  Notice both;
  both.text = "look here";
  both.picture = cv::Mat(240, 320, CV_8UC1, cv::Scalar(0));
  Notice words = both;
  words.picture.release();
  Notice picture = both;
  picture.text = {};
  const auto height = [&](const Notice& notice) {
    const NoticeLayout layout = LayOut(font, notice, 1280, 720);
    return layout.to.y - layout.from.y;
  };
  EXPECT_LT(height(words), height(both));
  EXPECT_LT(height(picture), height(both));
}

TEST(Notice, LargerLettersAreAsLargeAsThePictureLetsThemBe) {
  const CaptionFont font = Letters();
  Notice notice;
  notice.text = "look here\nplease";
  const float usual = LayOut(font, notice, 1280, 720).em;
  notice.style.size = CaptionSize::kLargest;
  EXPECT_NEAR(LayOut(font, notice, 1280, 720).em, 2.0f * usual, 1e-3f);
  notice.text = "look here\nplease\nor there\nas you like\nas you like";
  notice.picture = cv::Mat(240, 320, CV_8UC1, cv::Scalar(0));
  for (const auto& [width, height] : {std::pair(640, 480), {1280, 720}, {320, 240}, {480, 800}}) {
    EXPECT_TRUE(IsWithin(LayOut(font, notice, width, height), width, height)) << width;
  }
}

TEST(Notice, LongWordsBecomeSmallerRatherThanLeaveThePicture) {
  const CaptionFont font = Letters();
  Notice notice;
  const std::string text(200, 'm');
  notice.text = text;
  EXPECT_TRUE(IsWithin(LayOut(font, notice, 640, 480), 640, 480));
}

}  // namespace
}  // namespace lararium::render
