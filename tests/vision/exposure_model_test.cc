#include "shared/vision/exposure_model.h"

#include <gtest/gtest.h>

namespace lararium::vision {
namespace {

using geometry::Rigid3;

const Rigid3 kStep{geometry::RotationFromVector({0.02, 0.05, -0.01}), {0.1, 0.0, -0.05}};

double Distance(const Rigid3& a, const Rigid3& b) { return (a.Matrix3x4() - b.Matrix3x4()).norm(); }

// Adds an image one step after a pose, and returns its pose.
Rigid3 Move(ExposureModel& model, const Rigid3& before, const Rigid3& step) {
  const Rigid3 now = step * before;
  model.BeginImage(&before, 1.0);
  model.EndImage(now);
  return now;
}

TEST(ExposureModel, KnowsNoMotionWithoutThePoseBefore) {
  ExposureModel model;
  EXPECT_EQ(model.motion(), nullptr);
  Move(model, Rigid3(), kStep);
  EXPECT_NE(model.motion(), nullptr);
  model.BeginImage(nullptr, 1.0);
  EXPECT_EQ(model.motion(), nullptr);
}

TEST(ExposureModel, SteadyMotionHasNoAcceleration) {
  ExposureModel model;
  const Rigid3 pose = Move(model, Move(model, Rigid3(), kStep), kStep);
  EXPECT_LT(Distance(model.motion()->velocity, kStep), 1e-12);
  EXPECT_LT(Distance(model.motion()->acceleration, Rigid3()), 1e-12);
  // The doubt that an unknown acceleration left becomes smaller with every steady image.
  const double doubt = model.UnpredictedCovariance().trace();
  EXPECT_GT(doubt, 0.0);
  Move(model, pose, kStep);
  EXPECT_LT(model.UnpredictedCovariance().trace(), 0.8 * doubt);
}

TEST(ExposureModel, TurnsAsInTheImageItself) {
  ExposureModel model;
  const auto turn = [](double angle) {
    return Rigid3{geometry::RotationFromVector({0.0, angle, 0.0})};
  };
  Move(model, Move(model, Rigid3(), turn(0.1)), turn(0.3));
  EXPECT_NEAR(model.motion()->during_frame[1], 0.4, 1e-12);
  EXPECT_NEAR(geometry::VectorFromRotation(model.motion()->velocity.rotation).y(), 0.4, 1e-12);
  EXPECT_NEAR(geometry::VectorFromRotation(model.motion()->acceleration.rotation).y(), 0.2, 1e-12);
}

TEST(ExposureModel, ShiftsByTheMeanOfTheLastTwo) {
  ExposureModel model;
  const Rigid3 slow{Eigen::Quaterniond::Identity(), {0.1, 0.0, 0.0}};
  const Rigid3 fast{Eigen::Quaterniond::Identity(), {0.3, 0.0, 0.0}};
  Move(model, Move(model, Rigid3(), slow), fast);
  EXPECT_NEAR(model.motion()->velocity.translation.x(), 0.2, 1e-12);
  EXPECT_NEAR(model.motion()->acceleration.translation.x(), 0.2, 1e-12);
}

TEST(ExposureModel, LearnsTheShutterTimeThatFitsBest) {
  constexpr double kTruth = 0.55;
  ExposureModel model;
  Move(model, Rigid3(), kStep);
  const auto likeness = [](double shutter) { return -(shutter - kTruth) * (shutter - kTruth); };
  for (int trial = 0; trial < 20; ++trial) {
    EXPECT_EQ(model.shutter().has_value(), trial >= 3);
    const double now = model.motion()->shutter;
    model.LearnShutter(likeness(now - ExposureModel::kShutterStep), likeness(now),
                       likeness(now + ExposureModel::kShutterStep));
  }
  EXPECT_NEAR(*model.shutter(), kTruth, 0.01);
}

}  // namespace
}  // namespace lararium::vision
