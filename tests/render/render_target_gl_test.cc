#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include "shared/render/gl/render_target.h"
#include "shared/render/gl/texture.h"
#include "tests/render/gl_fixture.h"

namespace lararium::render {
namespace {

class RenderTargetTest : public GlTest {};

TEST_F(RenderTargetTest, ReadsTheTopRowFirst) {
  const RenderTarget target = MakeTarget(20, 30);
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);
  glScissor(3, 5, 1, 1);  // column 3; stored row 5 is the sixth from the top
  glClearColor(0.0f, 0.0f, 1.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  const cv::Mat bgr = Read(target);
  EXPECT_EQ(bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(bgr.at<cv::Vec3b>(5, 3), cv::Vec3b(255, 0, 0));
}

TEST_F(RenderTargetTest, RefusesImpossibleSizes) {
  EXPECT_FALSE(RenderTarget::Create(0, 10).ok());
  EXPECT_FALSE(RenderTarget::Create(10, 1 << 24).ok());
}

TEST_F(RenderTargetTest, TextureKeepsItsStorageWhileTheSizeStays) {
  Texture texture;
  EXPECT_EQ(texture.id(), 0u);
  texture.Upload(cv::Mat(9, 7, CV_8UC3, cv::Scalar::all(3)));
  const uint32_t id = texture.id();
  EXPECT_NE(id, 0u);
  texture.Upload(cv::Mat(90, 70, CV_8UC3)(cv::Rect(1, 1, 5, 6)).setTo(cv::Scalar::all(9)));
  EXPECT_EQ(texture.id(), id);
  EXPECT_EQ(texture.width(), 5);
  EXPECT_EQ(texture.height(), 6);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

}  // namespace
}  // namespace lararium::render
