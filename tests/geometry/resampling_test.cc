#include "shared/geometry/resampling.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace lararium::geometry {
namespace {

constexpr CameraModel kBarrelCamera{64, 48, 42.0, 43.0, 32.2, 23.6, -0.28, 0.07, 0.001, -0.0008};
constexpr CameraModel kPinhole{80, 30, 60.0, 60.0, 39.5, 14.5};

TEST(PixelsSeenBy, HasThePlaceOfTheSameRayForEachPixelOfTheOther) {
  const cv::Mat pixels = PixelsSeenBy(kBarrelCamera, kPinhole);
  ASSERT_EQ(pixels.size(), cv::Size(kPinhole.width, kPinhole.height));
  ASSERT_EQ(pixels.type(), CV_32FC2);
  for (int y = 0; y < kPinhole.height; ++y) {
    for (int x = 0; x < kPinhole.width; ++x) {
      const cv::Vec2f seen = pixels.at<cv::Vec2f>(y, x);
      const Eigen::Vector2d ray = kBarrelCamera.PlaneFromPixel({seen[0], seen[1]});
      EXPECT_LT((ray - kPinhole.PlaneFromPixel({x, y})).norm(), 1e-5) << x << ' ' << y;
    }
  }
}

TEST(PixelsSeenBy, FindsEachPixelAtItsOwnPlaceBetweenCamerasAlike) {
  const cv::Mat pixels = PixelsSeenBy(kBarrelCamera, kBarrelCamera);
  for (int y = 0; y < kBarrelCamera.height; ++y) {
    for (int x = 0; x < kBarrelCamera.width; ++x) {
      EXPECT_LT(cv::norm(pixels.at<cv::Vec2f>(y, x) - cv::Vec2f(x, y)), 1e-4) << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace lararium::geometry
