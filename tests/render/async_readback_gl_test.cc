#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "shared/render/gl/async_readback.h"
#include "tests/render/gl_fixture.h"

namespace lararium::render {
namespace {

class AsyncReadbackTest : public GlTest {
 protected:
  // Makes the lower left quarter red (the top row is stored first) and the rest black.
  static void Draw(const RenderTarget& target) {
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, target.height() / 2, target.width() / 2, target.height());
    glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    glDisable(GL_SCISSOR_TEST);
  }

  static cv::Mat Finished(AsyncReadback& mirror) {
    cv::Mat rgba;
    for (int i = 0; i < 1000 && !mirror.TryFinish(rgba); ++i) {
      glFinish();
    }
    return rgba;
  }
};

TEST_F(AsyncReadbackTest, IsTheSamePictureSmaller) {
  const RenderTarget target = MakeTarget(1280, 720);
  Draw(target);
  AsyncReadback mirror(320);
  mirror.Begin(target);
  EXPECT_TRUE(mirror.under_way());
  const cv::Mat rgba = Finished(mirror);
  EXPECT_FALSE(mirror.under_way());
  ASSERT_EQ(rgba.size(), cv::Size(320, 180));
  EXPECT_EQ(rgba.at<cv::Vec4b>(170, 10), cv::Vec4b(255, 0, 0, 255)) << "below, left";
  EXPECT_EQ(rgba.at<cv::Vec4b>(10, 10), cv::Vec4b(0, 0, 0, 255)) << "above: the top row first";
  EXPECT_EQ(rgba.at<cv::Vec4b>(170, 310), cv::Vec4b(0, 0, 0, 255));
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(AsyncReadbackTest, TakesAnySizeAndAnotherOneNextTime) {
  AsyncReadback mirror(320);
  for (const cv::Size size :
       {cv::Size(200, 100), cv::Size(641, 7), cv::Size(1, 1), cv::Size(1920, 1080)}) {
    const RenderTarget target = MakeTarget(size.width, size.height);
    Draw(target);
    mirror.Begin(target);
    const cv::Mat rgba = Finished(mirror);
    EXPECT_LE(rgba.cols, 320);
    EXPECT_GE(rgba.cols, std::min(size.width, 160));
  }
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(AsyncReadbackTest, NothingIsTakenThatWasNotAskedFor) {
  AsyncReadback mirror(320);
  cv::Mat rgba;
  EXPECT_FALSE(mirror.TryFinish(rgba));
  EXPECT_TRUE(rgba.empty());
}

}  // namespace
}  // namespace lararium::render
