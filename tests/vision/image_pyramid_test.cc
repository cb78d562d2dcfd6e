#include "shared/vision/image_pyramid.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace lararium::vision {
namespace {

TEST(ImagePyramid, KeepsARampWhereItIs) {
  cv::Mat ramp(96, 128, CV_8UC1);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) {
      ramp.at<uint8_t>(y, x) = static_cast<uint8_t>(x + y);
    }
  }
  ImagePyramid pyramid;
  pyramid.Build(ramp, 3);
  ASSERT_EQ(pyramid.levels(), 3);
  for (int level = 1; level < 3; ++level) {
    const cv::Mat& image = pyramid.level(level);
    EXPECT_EQ(image.cols, 128 >> level);
    for (int y = 2; y < image.rows - 2; ++y) {
      for (int x = 2; x < image.cols - 2; ++x) {
        const Eigen::Vector2d pixel = PixelFromLevel(Eigen::Vector2d(x, y), level);
        EXPECT_NEAR(image.at<uint8_t>(y, x), pixel.sum(), 0.51);
        EXPECT_NEAR((LevelFromPixel(pixel, level) - Eigen::Vector2d(x, y)).norm(), 0.0, 1e-12);
      }
    }
  }
}

TEST(ImagePyramid, StopsBeforeNothingIsLeftAndSharesTheImage) {
  const cv::Mat image(40, 200, CV_8UC1, cv::Scalar(77));
  ImagePyramid pyramid;
  pyramid.Build(image, 9);
  EXPECT_EQ(pyramid.levels(), 2);
  EXPECT_EQ(pyramid.level(0).data, image.data);
  EXPECT_EQ(cv::countNonZero(pyramid.level(1) != 77), 0);
}

}  // namespace
}  // namespace lararium::vision
