#include "shared/vision/image_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "shared/core/random.h"

namespace lararium::vision {
namespace {

constexpr int kWidth = 320;
constexpr int kHeight = 240;

// Discs, bars and ramps of all brightnesses. They are drawn large and reduced, so that edges are as
// sharp as pixels allow, and then blurred.
cv::Mat TexturedScene(uint64_t seed, double blur) {
  constexpr int kFine = 4;
  Random random(seed);
  cv::Mat fine(kFine * kHeight, kFine * kWidth, CV_32F);
  for (int y = 0; y < fine.rows; ++y) {
    for (int x = 0; x < fine.cols; ++x) {
      fine.at<float>(y, x) = 0.1f + 0.8f * static_cast<float>(x) / static_cast<float>(fine.cols);
    }
  }
  for (int i = 0; i < 14; ++i) {
    const cv::Point centre{static_cast<int>(random.Uniform(0, fine.cols)),
                           static_cast<int>(random.Uniform(0, fine.rows))};
    const int radius = static_cast<int>(random.Uniform(80, 180));
    cv::circle(fine, centre, radius, cv::Scalar(random.Uniform(0.1, 0.9)), cv::FILLED);
  }
  if (blur > 0.0) {
    cv::GaussianBlur(fine, fine, cv::Size(), kFine * blur);
  }
  cv::Mat image;
  cv::resize(fine, image, cv::Size(kWidth, kHeight), 0, 0, cv::INTER_AREA);
  return image;
}

cv::Mat WithNoise(const cv::Mat& scene, double floor, double slope, uint64_t seed) {
  Random random(seed);
  cv::Mat image(scene.size(), CV_8UC1);
  for (int y = 0; y < scene.rows; ++y) {
    for (int x = 0; x < scene.cols; ++x) {
      const double value = scene.at<float>(y, x);
      const double noisy =
          value + std::sqrt(floor * floor + slope * value) * static_cast<double>(random.Normal());
      image.at<uchar>(y, x) = cv::saturate_cast<uchar>(255.0 * noisy);
    }
  }
  return image;
}

TEST(EstimateNoise, FindsTheVarianceOfSyntheticNoiseByBrightness) {
  struct Case {
    double floor, slope;
  };
  for (const Case c : {Case{0.01, 0.0}, Case{0.03, 0.0}, Case{0.01, 0.0008}}) {
    std::vector<cv::Mat> images;
    for (uint64_t i = 0; i < 4; ++i) {
      images.push_back(WithNoise(TexturedScene(i, 1.0), c.floor, c.slope, 90 + i));
    }
    const auto noise = EstimateNoise(images);
    ASSERT_TRUE(noise.has_value());
    for (const double value : {0.2, 0.5, 0.8}) {
      const double expected = std::sqrt(c.floor * c.floor + c.slope * value);
      const double found = std::sqrt(noise->floor * noise->floor + noise->slope * value);
      EXPECT_NEAR(found, expected, 0.15 * expected)
          << "floor " << c.floor << ", slope " << c.slope << ", at " << value;
    }
  }
}

TEST(EstimateSharpness, FindsTheBlurOfSyntheticEdges) {
  for (const double blur : {0.6, 1.0, 1.6, 2.5}) {
    for (const double noise : {0.0, 0.01}) {
      std::vector<cv::Mat> images;
      for (uint64_t i = 0; i < 2; ++i) {
        images.push_back(WithNoise(TexturedScene(10 + i, blur), noise, 0.0, 50 + i));
      }
      const auto found = EstimateSharpness(images);
      ASSERT_TRUE(found.has_value());
      EXPECT_NEAR(*found, blur, 0.15 * blur + 0.15) << "noise " << noise;
    }
  }
}

TEST(ImageQuality, SaysNothingOfImagesThatShowNothing) {
  EXPECT_FALSE(EstimateNoise({}).has_value());
  EXPECT_FALSE(EstimateSharpness({}).has_value());
  const std::vector<cv::Mat> unfit = {cv::Mat(), cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(90)),
                                      cv::Mat(100, 100, CV_32FC1, cv::Scalar::all(0.5)),
                                      cv::Mat(100, 100, CV_8UC3, cv::Scalar::all(255))};
  EXPECT_FALSE(EstimateNoise(unfit).has_value());
  EXPECT_FALSE(EstimateSharpness(unfit).has_value());
}

}  // namespace
}  // namespace lararium::vision
