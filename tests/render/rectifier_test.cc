#include "shared/render/passes/rectifier.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace lararium::render {
namespace {

constexpr int kWidth = 160, kHeight = 120;

geometry::CameraModel Straight(double focal) {
  geometry::CameraModel camera;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.fx = camera.fy = focal;
  camera.cx = 0.5 * (kWidth - 1);
  camera.cy = 0.5 * (kHeight - 1);
  return camera;
}

geometry::CameraModel Bent() {
  geometry::CameraModel camera = Straight(130.0);
  camera.k1 = -0.21;
  camera.k2 = 0.05;
  camera.p1 = 0.002;
  camera.p2 = -0.003;
  return camera;
}

// An image whose blue encodes the column and whose green encodes the row.
cv::Mat TellingImage() {
  cv::Mat image(kHeight, kWidth, CV_8UC3);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      image.at<cv::Vec3b>(y, x) = cv::Vec3b(static_cast<uint8_t>(x), static_cast<uint8_t>(y), 255);
    }
  }
  return image;
}

TEST(Rectifier, ChangesNothingWhereTheCameraIsAPinhole) {
  const geometry::CameraModel camera = Straight(130.0);
  const cv::Mat image = TellingImage();
  Rectifier rectifier;
  EXPECT_EQ(cv::norm(rectifier.Rectify(image, camera, camera), image, cv::NORM_INF), 0.0);
}

TEST(Rectifier, EachPixelIsWhereTheCameraModelSeesItsRay) {
  const geometry::CameraModel camera = Bent();
  const geometry::CameraModel display = camera.DisplayPinhole().Resized(80, 60);
  Rectifier rectifier;
  const cv::Mat& rectified = rectifier.Rectify(TellingImage(), camera, display);
  ASSERT_EQ(rectified.size(), cv::Size(80, 60));
  for (int y = 1; y < 59; ++y) {
    for (int x = 1; x < 79; ++x) {
      const Eigen::Vector2d raw = camera.PixelFromPlane(display.PlaneFromPixel({x, y}));
      const cv::Vec3b seen = rectified.at<cv::Vec3b>(y, x);
      EXPECT_NEAR(seen[0], raw.x(), 0.6) << x << ' ' << y;
      EXPECT_NEAR(seen[1], raw.y(), 0.6) << x << ' ' << y;
    }
  }
}

TEST(Rectifier, WhatTheCameraDoesNotSeeIsBlack) {
  const geometry::CameraModel camera = Straight(130.0);
  const geometry::CameraModel wide = Straight(65.0);
  Rectifier rectifier;
  const cv::Mat& rectified = rectifier.Rectify(TellingImage(), camera, wide);
  EXPECT_EQ(rectified.at<cv::Vec3b>(5, 5), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(rectified.at<cv::Vec3b>(60, 80)[2], 255);
}

TEST(Rectifier, FollowsAnotherCamera) {
  Rectifier rectifier;
  const cv::Mat image = TellingImage();
  const geometry::CameraModel bent = Bent();
  (void)rectifier.Rectify(image, bent, bent.DisplayPinhole());
  const geometry::CameraModel pinhole = Straight(130.0);
  EXPECT_EQ(cv::norm(rectifier.Rectify(image, pinhole, pinhole), image, cv::NORM_INF), 0.0);
}

}  // namespace
}  // namespace lararium::render
