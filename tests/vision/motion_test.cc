// Tests the prediction of the camera's motion and its estimation from small images.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "shared/vision/motion_model.h"
#include "shared/vision/rotation_estimator.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

geometry::Frame FrameAt(int64_t index, double seconds) {
  geometry::Frame frame;
  frame.index = index;
  frame.capture_time = seconds;
  return frame;
}

// The times of frames that were taken at some seconds, in frame times.
std::vector<double> FrameTimes(std::span<const double> seconds) {
  FrameClock clock;
  std::vector<double> times;
  for (size_t i = 0; i < seconds.size(); ++i) {
    times.push_back(clock.Time(FrameAt(static_cast<int64_t>(i), seconds[i])));
  }
  return times;
}

TEST(FrameClock, CountsDroppedFramesOfAVariableRate) {
  // The second, third and sixth interval are longer by two frames, one, and a quarter.
  const std::array<double, 7> counts = {0.0, 1.0, 4.0, 6.0, 7.0, 8.0, 9.25};
  std::array<double, 7> seconds{};
  std::transform(counts.begin(), counts.end(), seconds.begin(),
                 [](double count) { return 5.0 + count / 30.0; });
  const std::vector<double> times = FrameTimes(seconds);
  for (size_t i = 1; i < counts.size(); ++i) {
    EXPECT_NEAR(times[i] - times[0], counts[i], 1e-9) << i;
  }
}

TEST(FrameClock, IgnoresRoundedTimes) {
  std::array<double, 60> seconds{};
  for (size_t i = 0; i < seconds.size(); ++i) {
    seconds[i] = std::floor(1000.0 * static_cast<double>(i) / 30.0) / 1000.0;
  }
  const std::vector<double> times = FrameTimes(seconds);
  for (size_t i = 0; i < seconds.size(); ++i) {
    EXPECT_EQ(times[i], static_cast<double>(i));
  }
}

TEST(FrameClock, KeepsItsUnitWhenTheRateChanges) {
  std::vector<double> seconds = {0.0};
  for (int i = 0; i < 90; ++i) {
    seconds.push_back(seconds.back() + (i < 30 ? 1.0 / 30.0 : 1.0 / 24.0));
  }
  const std::vector<double> times = FrameTimes(seconds);
  EXPECT_NEAR(times[30] - times[0], 30.0, 1e-9);
  EXPECT_NEAR(times[90] - times[30], 60.0 * 30.0 / 24.0, 1e-9);
}

TEST(FrameClock, CountsFramesWhoseTimesDoNotAscend) {
  EXPECT_THAT(FrameTimes(std::vector<double>{0.0, 0.0, 0.0}), testing::ElementsAre(0.0, 1.0, 2.0));
  FrameClock clock;
  clock.Time(FrameAt(7, 0.2));
  const double before = clock.Time(FrameAt(8, 0.3));
  EXPECT_EQ(clock.Time(FrameAt(2, 0.0)), before) << "the film was set back";
  EXPECT_EQ(clock.Time(FrameAt(3, 0.1)), before + 1.0);
}

TEST(MotionModel, GoesOnAsBefore) {
  const Rigid3 step{geometry::RotationFromVector({0.02, 0.05, -0.01}), {0.1, 0.0, -0.05}};
  const Rigid3 first{geometry::RotationFromVector({0.3, 0.1, 0.2}), {1.0, 2.0, 3.0}};
  MotionModel model;
  EXPECT_FALSE(model.has_pose());
  model.Add(4.0, first);
  EXPECT_LT((model.Motion(1.0).Matrix3x4() - Rigid3().Matrix3x4()).norm(), 1e-12);
  model.Add(5.0, step * first);
  EXPECT_LT((model.Motion(1.0).Matrix3x4() - step.Matrix3x4()).norm(), 1e-12);
  // After a dropped frame, the same velocity applies over twice the time.
  EXPECT_NEAR(geometry::VectorFromRotation(model.Motion(2.0).rotation).norm(),
              2.0 * geometry::VectorFromRotation(step.rotation).norm(), 1e-12);
  model.Forget();
  EXPECT_FALSE(model.has_pose());
}

TEST(MotionModel, KeepsTheMotionWhenThePoseIsCorrected) {
  const Rigid3 step{geometry::RotationFromVector({0.02, 0.05, -0.01}), {0.1, 0.0, -0.05}};
  const Rigid3 right{geometry::RotationFromVector({-0.4, 0.2, 0.1}), {0.5, -1.0, 2.0}};
  MotionModel model;
  model.Add(4.0, Rigid3());
  model.Add(5.0, step);
  model.Correct(right);
  EXPECT_EQ(model.last_pose().Matrix3x4(), right.Matrix3x4());
  EXPECT_EQ(model.last_time(), 5.0);
  EXPECT_LT((model.Motion(1.0).Matrix3x4() - step.Matrix3x4()).norm(), 1e-12);
}

const CameraModel kSmall = {
    .width = 40, .height = 30, .fx = 35.0, .fy = 35.0, .cx = 19.5, .cy = 14.5};

// An image of a distant scene, whose brightness depends on the direction only.
cv::Mat Look(const Eigen::Quaterniond& camera_from_world, double gain) {
  cv::Mat image(kSmall.height, kSmall.width, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const Eigen::Vector3d d =
          camera_from_world.conjugate() *
          kSmall.PlaneFromPixel({static_cast<double>(x), static_cast<double>(y)})
              .homogeneous()
              .normalized();
      const double value = 110.0 + 30.0 * std::sin(7.0 * d.x() + 3.0 * d.y()) +
                           30.0 * std::sin(2.0 * d.x() - 9.0 * d.y() + 1.0) +
                           20.0 * std::sin(15.0 * d.x() + 12.0 * d.z());
      image.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(gain * value);
    }
  }
  return image;
}

TEST(EstimateRotation, SeesATurnInOtherLight) {
  for (const Eigen::Vector3d& turn :
       {Eigen::Vector3d(0.0, 0.08, 0.0), Eigen::Vector3d(-0.05, 0.03, 0.06)}) {
    const Eigen::Quaterniond before = geometry::RotationFromVector({0.1, 0.2, 0.0});
    const Eigen::Quaterniond now_from_before = geometry::RotationFromVector(turn);
    const auto estimate = EstimateRotation(Look(before, 1.0), Look(now_from_before * before, 0.7),
                                           kSmall, Eigen::Quaterniond::Identity());
    ASSERT_TRUE(estimate.has_value());
    EXPECT_LT(estimate->now_from_before.angularDistance(now_from_before) * kSmall.fx, 0.05);
    EXPECT_LT(estimate->noise, 2.0);
  }
}

TEST(EstimateRotation, SeesNothingInTheDark) {
  const cv::Mat black(kSmall.height, kSmall.width, CV_8UC1, cv::Scalar(0));
  const auto estimate = EstimateRotation(black, black, kSmall, Eigen::Quaterniond::Identity());
  // Without contrast the rotation stays at its start.
  EXPECT_TRUE(!estimate ||
              estimate->now_from_before.angularDistance(Eigen::Quaterniond::Identity()) < 1e-6);
}

}  // namespace
}  // namespace lararium::vision
