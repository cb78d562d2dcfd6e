#include "editor/train/keyframes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "shared/core/random.h"

namespace lararium::train {
namespace {

TEST(ChooseKeyframes, TakesAllOfAShortSource) {
  const std::vector<FrameMotion> frames(5);
  EXPECT_EQ(ChooseKeyframes(frames, 5).size(), 5u);
}

TEST(ChooseKeyframes, SpreadsEvenlyOverEvenMotion) {
  const std::vector<FrameMotion> frames(1000, {.shift = 0.01, .sharpness = 1.0});
  const std::vector<size_t> chosen = ChooseKeyframes(frames, 100);
  EXPECT_LE(chosen.size(), 100u);
  EXPECT_GE(chosen.size(), 95u);
  for (size_t i = 1; i < chosen.size(); ++i) {
    EXPECT_GE(chosen[i] - chosen[i - 1], 9u);
    EXPECT_LE(chosen[i] - chosen[i - 1], 11u);
  }
}

TEST(ChooseKeyframes, SpendsFewOnAStandingCamera) {
  std::vector<FrameMotion> frames(1000);
  for (size_t i = 500; i < 1000; ++i) {
    frames[i].shift = 0.01;
  }
  const std::vector<size_t> chosen = ChooseKeyframes(frames, 100);
  EXPECT_EQ(std::count_if(chosen.begin(), chosen.end(), [](size_t i) { return i < 499; }), 1);
  EXPECT_GE(chosen.size(), 95u);
}

TEST(ChooseKeyframes, PrefersSharpFrames) {
  std::vector<FrameMotion> frames(300, {.shift = 0.01, .sharpness = 1.0});
  for (size_t i = 0; i < frames.size(); i += 3) {
    frames[i].sharpness = 5.0;
  }
  for (const size_t i : ChooseKeyframes(frames, 30)) {
    EXPECT_EQ(i % 3, 0u);
  }
}

cv::Mat Texture() {
  Random random(1);
  cv::Mat image(240, 320, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image.at<uint8_t>(y, x) = static_cast<uint8_t>(random.Below(256));
    }
  }
  cv::GaussianBlur(image, image, cv::Size(), 3.0);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

TEST(MotionMeter, MeasuresAShiftAsShareOfTheDiagonal) {
  const cv::Mat image = Texture();
  const cv::Matx23d shift(1, 0, 6, 0, 1, 8);
  cv::Mat moved;
  cv::warpAffine(image, moved, shift, image.size());
  MotionMeter meter;
  EXPECT_EQ(meter.Measure(image).shift, 0.0);
  EXPECT_NEAR(meter.Measure(moved).shift, 10.0 / 400.0, 1e-3);
}

TEST(MotionMeter, CallsUnconnectedFramesLost) {
  MotionMeter meter;
  (void)meter.Measure(cv::Mat::zeros(240, 320, CV_8UC1));
  EXPECT_EQ(meter.Measure(Texture()).shift, kLostShift);
}

TEST(MotionMeter, FindsBlurredFramesLessSharp) {
  const cv::Mat image = Texture();
  cv::Mat blurred;
  cv::GaussianBlur(image, blurred, cv::Size(), 4.0);
  MotionMeter meter;
  EXPECT_GT(meter.Measure(image).sharpness, 4.0 * meter.Measure(blurred).sharpness);
}

}  // namespace
}  // namespace lararium::train
