#include <epoxy/gl.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "shared/render/text/captions.h"
#include "tests/render/gl_fixture.h"

namespace lararium::render {
namespace {

class CaptionsTest : public GlTest {
 protected:
  // A letter "a" that fills half an em. Its outline lies 4 pixels inside the atlas.
  static CaptionFont OneLetter() {
    CaptionFont font;
    font.em_px = 32.0f;
    font.rim_px = 4.0f;
    font.atlas = cv::Mat(24, 24, CV_8UC1, cv::Scalar(0));
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) {
        const float inside = std::min(std::min(x, 23 - x), std::min(y, 23 - y)) + 0.5f - 4.0f;
        font.atlas.at<uchar>(y, x) =
            cv::saturate_cast<uchar>(255.0f * (0.5f + inside / (2.0f * font.rim_px)));
      }
    }
    font.glyphs.push_back(
        {'a', 0.75f, {0.0f, -0.75f}, {0.75f, 0.0f}, {0.0f, 0.0f}, {24.0f, 24.0f}});
    return font;
  }

  static void Fill(const RenderTarget& target, float grey) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
    glClearColor(grey, grey, grey, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
  }
};

TEST_F(CaptionsTest, LettersAreWhiteOnADarkGroundWhereTheyWereLaidOut) {
  auto painter = CaptionPainter::Create(OneLetter());
  ASSERT_TRUE(painter.ok()) << painter.message();
  const RenderTarget target = MakeTarget(320, 240);
  Fill(target, 1.0f);
  const Caption caption = {"", glm::vec3(1.0f), CaptionSide::kHere, "a"};
  (*painter)->Draw({&caption, 1}, nullptr, {}, target);
  const cv::Mat picture = Read(target);
  CaptionLayout layout;
  LayOut(OneLetter(), {&caption, 1}, {}, 320, 240, layout);
  ASSERT_EQ(layout.rows.size(), 1u);
  const CaptionLayout::Row& row = layout.rows[0];
  const auto at = [&](float em_x, float em_y) {
    return picture.at<cv::Vec3b>(static_cast<int>(row.baseline.y + row.em * em_y),
                                 static_cast<int>(row.baseline.x + row.em * em_x));
  };
  EXPECT_EQ(at(0.375f, -0.375f), cv::Vec3b(255, 255, 255)) << "in the letter";
  EXPECT_LT(at(0.03f, -0.03f)[0], 100) << "beside it is the ground";
  EXPECT_EQ(picture.at<cv::Vec3b>(5, 5), cv::Vec3b(255, 255, 255)) << "the picture stays";
  // The letter is half an em wide, and so is the white part of its middle row.
  int white = 0;
  const int y = static_cast<int>(row.baseline.y - 0.375f * row.em);
  for (int x = static_cast<int>(layout.grounds[0].from.x) + 2;
       x < static_cast<int>(layout.grounds[0].to.x) - 2; ++x) {
    white += picture.at<cv::Vec3b>(y, x)[1] > 128 ? 1 : 0;
  }
  EXPECT_NEAR(white, 0.5f * row.em, 1.5f);
}

TEST_F(CaptionsTest, HighContrastIsBolderOnABlackGroundWithAnEdge) {
  auto painter = CaptionPainter::Create(OneLetter());
  ASSERT_TRUE(painter.ok()) << painter.message();
  const RenderTarget target = MakeTarget(640, 480);
  const Caption caption = {"", glm::vec3(1.0f), CaptionSide::kHere, "a"};
  const auto white_in_the_letters_row = [&](const CaptionStyle& style, int& ground, int& edge) {
    Fill(target, 0.5f);
    (*painter)->Draw({&caption, 1}, nullptr, style, target);
    const cv::Mat picture = Read(target);
    CaptionLayout layout;
    LayOut(OneLetter(), {&caption, 1}, style, 640, 480, layout);
    const CaptionLayout::Ground& box = layout.grounds[0];
    const auto middle_x = static_cast<int>(0.5f * (box.from.x + box.to.x));
    ground = picture.at<cv::Vec3b>(static_cast<int>(box.to.y) - 4, middle_x)[1];
    edge = picture.at<cv::Vec3b>(static_cast<int>(box.to.y + 0.5f * box.edge_px), middle_x)[1];
    const auto y = static_cast<int>(layout.rows[0].baseline.y - 0.375f * layout.rows[0].em);
    double white = 0.0;
    for (int x = static_cast<int>(box.from.x) + 2; x < static_cast<int>(box.to.x) - 2; ++x) {
      white += (picture.at<cv::Vec3b>(y, x)[1] - ground) / 255.0;
    }
    return white;
  };
  int ground = 0;
  int edge = 0;
  const double usual = white_in_the_letters_row({}, ground, edge);
  EXPECT_GT(ground, 20);
  EXPECT_LT(edge, 140);
  const double bold =
      white_in_the_letters_row({CaptionSize::kNormal, CaptionContrast::kHigh}, ground, edge);
  EXPECT_EQ(ground, 0);
  EXPECT_EQ(edge, 255);
  EXPECT_GT(bold, usual + 0.5);
}

TEST_F(CaptionsTest, NothingToReadDrawsNothing) {
  auto painter = CaptionPainter::Create(OneLetter());
  ASSERT_TRUE(painter.ok()) << painter.message();
  const RenderTarget target = MakeTarget(64, 48);
  Fill(target, 1.0f);
  (*painter)->Draw({}, nullptr, {}, target);
  EXPECT_EQ(cv::sum(Read(target))[0], 255.0 * 64 * 48);
}

}  // namespace
}  // namespace lararium::render
