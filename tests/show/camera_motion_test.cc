#include "shared/show/camera_motion.h"

#include <gtest/gtest.h>

namespace lararium::show {
namespace {

geometry::Rigid3 At(double x) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0.0, 0.0)};
}

TEST(CameraMotionTracker, KnowsTheMotionFromTheFrameBefore) {
  CameraMotionTracker motion;
  EXPECT_FALSE(motion.Update(10, At(0.0)).has_value());
  const auto next = motion.Update(11, At(1.0));
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(next->frames, 1);
  EXPECT_EQ(next->before_from_stage.translation.x(), 0.0);
  const auto dropped = motion.Update(14, At(4.0));
  ASSERT_TRUE(dropped.has_value());
  EXPECT_EQ(dropped->frames, 3);
  EXPECT_EQ(dropped->before_from_stage.translation.x(), 1.0);
}

TEST(CameraMotionTracker, ThePausedFrameKeepsItsMotion) {
  CameraMotionTracker motion;
  motion.Update(3, At(0.0));
  motion.Update(4, At(1.0));
  const auto again = motion.Update(4, At(1.5));
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->before_from_stage.translation.x(), 0.0);
  EXPECT_EQ(motion.Update(5, At(2.0))->before_from_stage.translation.x(), 1.5);
}

TEST(CameraMotionTracker, SaysNothingAfterGapsAndLeaps) {
  CameraMotionTracker motion;
  motion.Update(3, At(0.0));
  EXPECT_FALSE(motion.Update(3 + CameraMotionTracker::kLongest + 1, At(1.0)).has_value());
  EXPECT_FALSE(motion.Update(0, At(2.0)).has_value()) << "back to the beginning";
  motion.Reset();
  EXPECT_FALSE(motion.Update(1, At(3.0)).has_value());
}

}  // namespace
}  // namespace lararium::show
