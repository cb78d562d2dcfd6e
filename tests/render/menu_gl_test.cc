#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "shared/render/text/menu.h"
#include "tests/render/gl_fixture.h"

namespace lararium::render {
namespace {

class MenuTest : public GlTest {
 protected:
  static cv::Mat Draw(const Menu& menu) {
    auto painter = FlatPainter::Create(CaptionFont());
    EXPECT_TRUE(painter.ok()) << painter.message();
    const RenderTarget target = MakeTarget(200, 100);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
    glClearColor(1.0f, 1.0f, 1.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    DrawMenu(**painter, menu, target);
    return Read(target);
  }
  static int Bright(const cv::Mat& picture, int x, int y) {
    return picture.at<cv::Vec3b>(y, x)[2];  // red
  }
};

TEST_F(MenuTest, FillsAsMuchOfACellAsItWasLookedAt) {
  Menu menu;
  menu.cells = {{{20.0f, 20.0f}, {100.0f, 50.0f}, "", true, 0.5f}};
  menu.gaze = {150.0f, 80.0f};
  const cv::Mat picture = Draw(menu);
  EXPECT_GT(Bright(picture, 50, 35), Bright(picture, 75, 35) + 60);
  EXPECT_EQ(Bright(picture, 10, 35), 255) << "beside it the picture stays";
  EXPECT_LT(Bright(picture, 90, 35), 120);
}

TEST_F(MenuTest, FadesAsAWholeWhereNothingIsToMove) {
  Menu menu;
  menu.fades = true;
  menu.gaze = {150.0f, 80.0f};
  menu.cells = {{{20.0f, 20.0f}, {100.0f, 50.0f}, "", true, 0.0f}};
  const int before = Bright(Draw(menu), 50, 35);
  menu.cells[0].progress = 0.5f;
  const cv::Mat picture = Draw(menu);
  EXPECT_GT(Bright(picture, 30, 35), before + 30);
  EXPECT_EQ(Bright(picture, 30, 35), Bright(picture, 90, 35));
}

TEST_F(MenuTest, IsBlackWithAWhiteEdgeInHighContrast) {
  Menu menu;
  menu.style.contrast = CaptionContrast::kHigh;
  menu.gaze = {150.0f, 80.0f};
  menu.cells = {{{20.0f, 20.0f}, {100.0f, 80.0f}, "", false, 0.0f}};
  const cv::Mat picture = Draw(menu);
  EXPECT_EQ(Bright(picture, 60, 50), 0);
  EXPECT_EQ(Bright(picture, 60, 19), 255);
}

TEST_F(MenuTest, MarksThePointThatIsLookedAtOverItsCell) {
  Menu menu;
  menu.cells = {{{20.0f, 20.0f}, {100.0f, 50.0f}, "", false, 0.0f}};
  menu.gaze = {60.0f, 35.0f};
  const cv::Mat picture = Draw(menu);
  EXPECT_EQ(Bright(picture, 60, 35), 255);
  EXPECT_LT(Bright(picture, 70, 35), 120);
}

}  // namespace
}  // namespace lararium::render
