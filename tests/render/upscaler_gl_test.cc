#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "shared/render/passes/upscaler.h"
#include "tests/render/gl_fixture.h"

namespace lararium::render {
namespace {

class UpscalerTest : public GlTest {
 protected:
  // Every channel of every pixel is noise, so that no two neighbours are equal.
  static void FillWithNoise(const RenderTarget& target) {
    cv::Mat noise(target.height(), target.width(), CV_8UC4);
    cv::RNG random(7);
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    glBindTexture(GL_TEXTURE_2D, target.texture());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, noise.cols, noise.rows, GL_RGBA, GL_UNSIGNED_BYTE,
                    noise.data);
  }

  static cv::Mat Enlarged(Upscaler::Way way, const RenderTarget& picture, int width, int height) {
    auto upscaler = Upscaler::Create(way);
    EXPECT_TRUE(upscaler.ok()) << upscaler.message();
    const RenderTarget target = MakeTarget(width, height);
    upscaler->Upscale(picture, target);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return Read(target);
  }
};

TEST_F(UpscalerTest, BothWaysMakeThePictureThatIsBetweenItsPixelsLinear) {
  const RenderTarget picture = MakeTarget(64, 36);
  FillWithNoise(picture);
  const cv::Mat small = Read(picture);
  for (const cv::Size size : {cv::Size(128, 72), cv::Size(97, 55), cv::Size(64, 36)}) {
    const cv::Mat shaders = Enlarged(Upscaler::Way::kShaders, picture, size.width, size.height);
    const cv::Mat processor = Enlarged(Upscaler::Way::kProcessor, picture, size.width, size.height);
    ASSERT_EQ(processor.size(), size);
    EXPECT_LE(cv::norm(shaders, processor, cv::NORM_INF), 1.0) << size;
    // At twice the size, bilinear weights are products of 1/4 and 3/4.
    if (size.width == 128) {
      const cv::Vec3b here = small.at<cv::Vec3b>(10, 20);
      const cv::Vec3b left = small.at<cv::Vec3b>(10, 19);
      const cv::Vec3b above = small.at<cv::Vec3b>(9, 20);
      const cv::Vec3b beside = small.at<cv::Vec3b>(9, 19);
      for (int c = 0; c < 3; ++c) {
        const double wanted = 0.0625 * (9.0 * here[c] + 3.0 * left[c] + 3.0 * above[c] + beside[c]);
        EXPECT_NEAR(processor.at<cv::Vec3b>(20, 40)[c], wanted, 1.0);
      }
    }
  }
}

TEST_F(UpscalerTest, WhatIsDrawnNextGoesOverTheLargePicture) {
  const RenderTarget picture = MakeTarget(16, 16);
  FillWithNoise(picture);
  const RenderTarget target = MakeTarget(32, 32);
  for (const Upscaler::Way way : {Upscaler::Way::kShaders, Upscaler::Way::kProcessor}) {
    auto upscaler = Upscaler::Create(way);
    ASSERT_TRUE(upscaler.ok()) << upscaler.message();
    upscaler->Upscale(picture, target);
    glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    EXPECT_EQ(Read(target).at<cv::Vec3b>(31, 31), cv::Vec3b(0, 0, 255));
  }
}

}  // namespace
}  // namespace lararium::render
