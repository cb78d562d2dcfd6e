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
  const auto next = motion.Update(11, At(0.1));
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(next->frames, 1);
  EXPECT_EQ(next->before_from_stage.translation.x(), 0.0);
  const auto dropped = motion.Update(14, At(0.4));
  ASSERT_TRUE(dropped.has_value());
  EXPECT_EQ(dropped->frames, 3);
  EXPECT_EQ(dropped->before_from_stage.translation.x(), 0.1);
}

TEST(CameraMotionTracker, ThePausedFrameKeepsItsMotion) {
  CameraMotionTracker motion;
  motion.Update(3, At(0.0));
  motion.Update(4, At(0.1));
  const auto again = motion.Update(4, At(0.15));
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->before_from_stage.translation.x(), 0.0);
  EXPECT_EQ(motion.Update(5, At(0.2))->before_from_stage.translation.x(), 0.15);
}

TEST(CameraMotionTracker, SaysNothingAfterGapsAndLeaps) {
  CameraMotionTracker motion;
  motion.Update(3, At(0.0));
  EXPECT_FALSE(motion.Update(3 + CameraMotionTracker::kLongest + 1, At(0.1)).has_value());
  EXPECT_FALSE(motion.Update(0, At(0.2)).has_value()) << "back to the beginning";
  motion.Reset();
  EXPECT_FALSE(motion.Update(1, At(0.3)).has_value());
}

TEST(CameraMotionTracker, ALeapIsNoMotion) {
  CameraMotionTracker motion;
  motion.Update(1, At(0.0));
  EXPECT_FALSE(motion.Update(2, At(1.5)).has_value()) << "found elsewhere";
  EXPECT_TRUE(motion.Update(3, At(1.6)).has_value()) << "and followed from there";
  geometry::Rigid3 turned = At(0.0);
  EXPECT_FALSE(motion.Update(4, turned).has_value());
  turned.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY());
  EXPECT_FALSE(motion.Update(5, turned).has_value());
  turned.rotation = Eigen::AngleAxisd(1.05, Eigen::Vector3d::UnitY());
  EXPECT_TRUE(motion.Update(6, turned).has_value()) << "a quick turn of the head";
}

TEST(Predict, GoesOnAsFastAsBefore) {
  const geometry::Rigid3 step = {
      .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.02, Eigen::Vector3d(0.6, 0.8, 0.0))),
      .translation = {0.01, -0.02, 0.005}};
  const geometry::Rigid3 before = {
      .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(1.2, Eigen::Vector3d::UnitX())),
      .translation = {0.3, 1.6, -2.0}};
  const geometry::Rigid3 now = step * step * before;
  const CameraMotion motion{before, 2};
  const geometry::Rigid3 later = Predict(motion, now, 2.0);
  const geometry::Rigid3 expected = step * step * now;
  EXPECT_LT(later.rotation.angularDistance(expected.rotation), 1e-9);
  // A rotation on the way displaces the position a little.
  EXPECT_LT((later.translation - expected.translation).norm(), 1e-4);
  const geometry::Rigid3 same = Predict(motion, now, 0.0);
  EXPECT_LT(same.rotation.angularDistance(now.rotation), 1e-9);
  EXPECT_LT((same.translation - now.translation).norm(), 1e-12);
}

TEST(Predict, WhoStandsStays) {
  const geometry::Rigid3 later = Predict({At(0.4), 1}, At(0.4), 3.0);
  EXPECT_EQ(later.translation.x(), 0.4);
  EXPECT_EQ(later.rotation.angularDistance(Eigen::Quaterniond::Identity()), 0.0);
}

}  // namespace
}  // namespace lararium::show
