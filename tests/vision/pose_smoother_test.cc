#include "shared/vision/pose_smoother.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "shared/core/random.h"

namespace lararium::vision {
namespace {

using geometry::Rigid3;

constexpr double kFrame = 1.0 / 30.0;
constexpr geometry::CameraModel kSmoothedCamera{640, 480, 500, 500, 319.5, 239.5};

// A grid 2 m in front of the camera.
std::vector<Eigen::Vector3d> Landmarks() {
  std::vector<Eigen::Vector3d> points;
  for (double x = -1.0; x <= 1.0; x += 0.25) {
    for (double y = -0.75; y <= 0.75; y += 0.25) {
      points.emplace_back(x, y, 2.0);
    }
  }
  return points;
}

// A pose moved sideways, so that every landmark moves by this many pixels.
Rigid3 Sideways(double pixels) {
  Rigid3 pose;
  pose.translation.x() = pixels * 2.0 / 500.0;
  return pose;
}
double Pixels(const Rigid3& pose) { return pose.translation.x() * 500.0 / 2.0; }

class PoseSmootherTest : public ::testing::Test {
 protected:
  void Make(const PoseSmootherOptions& options) { smoother_.emplace(options, Grid()); }
  static std::vector<std::vector<Eigen::Vector3d>> Grid() { return {Landmarks()}; }

  // Passes a pose through the smoother and returns the result.
  Rigid3 Apply(double time, const Rigid3& pose, bool followed, uint32_t map = 0) {
    TrackedFrame tracked;
    tracked.frame.capture_time = time;
    tracked.camera = kSmoothedCamera;
    tracked.camera_from_map = pose;
    tracked.map = map;
    tracked.followed = followed;
    tracked.covariance = covariance_;
    smoother_->Apply(tracked);
    return *tracked.camera_from_map;
  }
  void Lose(double time) {
    TrackedFrame tracked;
    tracked.frame.capture_time = time;
    smoother_->Apply(tracked);
    EXPECT_FALSE(tracked.camera_from_map);
  }

  std::optional<PoseSmoother> smoother_;
  // Corresponds to a noise of 0.1 pixels.
  Eigen::Matrix<double, 6, 6> covariance_ =
      std::pow(0.1 / 500.0, 2) * Eigen::Matrix<double, 6, 6>::Identity();
};

TEST(PoseSmootherMathsTest, ATwistTakesOnePoseToTheOther) {
  Rigid3 from{geometry::RotationFromVector({0.1, -0.2, 0.3}), {1.0, 2.0, 3.0}};
  Rigid3 to{geometry::RotationFromVector({-0.4, 0.1, 0.2}), {0.5, 2.5, 2.0}};
  const Rigid3 there = Moved(from, TwistBetween(from, to));
  EXPECT_LT(there.rotation.angularDistance(to.rotation), 1e-12);
  EXPECT_LT((there.translation - to.translation).norm(), 1e-12);
  EXPECT_LT(TwistBetween(from, from).norm(), 1e-12);
}

TEST(PoseSmootherMathsTest, ThePictureShiftIsThatOfTheNearestLandmarkInView) {
  const std::vector<Eigen::Vector3d> landmarks = {{0, 0, 2}, {0.1, 0, 4}, {0, 0, -2}, {50, 0, 1}};
  EXPECT_NEAR(PictureShift(kSmoothedCamera, landmarks, Rigid3(), Sideways(3.0)).value(), 3.0, 1e-9);
  EXPECT_FALSE(
      PictureShift(kSmoothedCamera, std::vector<Eigen::Vector3d>{{0, 0, -1}}, Rigid3(), Rigid3()));
}

TEST_F(PoseSmootherTest, FollowedPosesPassUnchangedWhereOnlyCorrectionIsAsked) {
  Make(PoseSmootherOptions::Of(Smoothing::kSoft));
  for (int i = 0; i < 50; ++i) {
    const Rigid3 pose = Sideways(10.0 * std::sin(0.3 * i));
    EXPECT_EQ(Pixels(Apply(i * kFrame, pose, i > 0)), Pixels(pose));
  }
}

TEST_F(PoseSmootherTest, ASmallCorrectionIsTakenBackSmoothlyInItsTimeAndNeverOvershoots) {
  Make(PoseSmootherOptions::Of(Smoothing::kSoft));
  for (int i = 0; i < 10; ++i) {
    Apply(i * kFrame, Sideways(0.0), i > 0);
  }
  double last = 0.0;
  for (int i = 10; i < 30; ++i) {
    const double x = Pixels(Apply(i * kFrame, Sideways(3.0), i > 10));
    const double share = (i - 10) * kFrame / PoseSmootherOptions().correction_seconds;
    EXPECT_GE(x, last - 1e-9) << "frame " << i;  // monotonic
    EXPECT_LE(x, 3.0 + 1e-9);
    EXPECT_LT(x - last, 3.0 * 1.5 * kFrame / PoseSmootherOptions().correction_seconds + 1e-9)
        << "steps stay below the steepest of the blend";
    if (share >= 1.0) {
      EXPECT_EQ(x, Pixels(Sideways(3.0))) << "over at its time, exactly";
    }
    last = x;
  }
  EXPECT_EQ(last, Pixels(Sideways(3.0)));
}

TEST_F(PoseSmootherTest, AMovingCameraKeepsMovingThroughACorrection) {
  Make(PoseSmootherOptions::Of(Smoothing::kSoft));
  const double speed = 5.0;  // pixels per frame
  double last = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double drift = i < 10 ? 2.0 : 0.0;  // The drift of tracking before relocalisation.
    const double x = Pixels(Apply(i * kFrame, Sideways(speed * i + drift), i != 0 && i != 10));
    if (i > 0) {
      EXPECT_NEAR(x - last, speed, 0.5) << "frame " << i;
    }
    last = x;
  }
  EXPECT_NEAR(last, speed * 29, 1e-9);
}

TEST_F(PoseSmootherTest, ALargeCorrectionIsDroppedAtOnce) {
  Make(PoseSmootherOptions::Of(Smoothing::kSoft));
  Apply(0.0, Sideways(0.0), false);
  Apply(kFrame, Sideways(0.0), true);
  EXPECT_EQ(Pixels(Apply(2 * kFrame, Sideways(9.0), false)), Pixels(Sideways(9.0)));
  EXPECT_EQ(Pixels(Apply(3 * kFrame, Sideways(9.0), true)), Pixels(Sideways(9.0)));
}

TEST_F(PoseSmootherTest, WhatIsShownNeverStraysByMoreThanTheBound) {
  Make(PoseSmootherOptions::Of(Smoothing::kSoft));
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const Rigid3 pose = Sideways(random.Uniform(-6.0, 6.0));
    const Rigid3 shown = Apply(i * kFrame, pose, random.Uniform() < 0.7);
    EXPECT_LE(PictureShift(kSmoothedCamera, Landmarks(), pose, shown).value(),
              PoseSmootherOptions().correction_px);
  }
}

TEST_F(PoseSmootherTest, PosesFoundAnewFrameAfterFramePassUnchanged) {
  Make(PoseSmootherOptions::Of(Smoothing::kSoft));
  for (int i = 0; i < 20; ++i) {
    const Rigid3 pose = Sideways(i % 3);
    EXPECT_EQ(Pixels(Apply(i * kFrame, pose, false)), Pixels(pose));
  }
}

TEST_F(PoseSmootherTest, NothingIsCarriedOverALossOrToAnotherMap) {
  Make(PoseSmootherOptions::Of(Smoothing::kStrong));
  Apply(0.0, Sideways(0.0), false);
  Apply(kFrame, Sideways(0.0), true);
  Lose(2 * kFrame);
  EXPECT_EQ(Pixels(Apply(3 * kFrame, Sideways(2.0), false)), Pixels(Sideways(2.0)));
  EXPECT_EQ(Pixels(Apply(4 * kFrame, Sideways(1.0), false, 1)), Pixels(Sideways(1.0)));
  EXPECT_EQ(Pixels(Apply(4 * kFrame, Sideways(3.0), true, 1)), Pixels(Sideways(3.0)))
      << "time that stands still starts afresh";
}

TEST_F(PoseSmootherTest, TheFilterGoesToAStepWithoutOvershootAndArrives) {
  Make(PoseSmootherOptions::Of(Smoothing::kStrong));
  Apply(0.0, Sideways(0.0), true);
  double last = 0.0;
  for (int i = 1; i < 120; ++i) {
    const double x = Pixels(Apply(i * kFrame, Sideways(1.0), true));
    EXPECT_GE(x, last - 1e-12);
    EXPECT_LE(x, 1.0 + 1e-12);
    last = x;
  }
  EXPECT_NEAR(last, 1.0, 1e-6);
}

TEST_F(PoseSmootherTest, TheFilterCalmsAStillCamera) {
  Make(PoseSmootherOptions::Of(Smoothing::kStrong));
  Random random(3);
  double in = 0.0;
  double out = 0.0;
  for (int i = 0; i < 600; ++i) {
    const Twist noise = Twist::NullaryExpr([&] { return 0.1 / 500.0 * random.Normal(); });
    const Rigid3 noisy = Moved(Rigid3(), noise);
    const Rigid3 calm = Apply(i * kFrame, noisy, true);
    if (i > 60) {
      in += std::pow(PictureShift(kSmoothedCamera, Landmarks(), Rigid3(), noisy).value(), 2);
      out += std::pow(PictureShift(kSmoothedCamera, Landmarks(), Rigid3(), calm).value(), 2);
    }
  }
  // A low-pass with gain g keeps g / (2 - g) of the variance of white noise, which is 0.10 at 1 Hz
  // and 30 frames per second.
  EXPECT_LT(out, 0.15 * in);
}

TEST_F(PoseSmootherTest, TheFilterOpensWhereTheCameraMoves) {
  Make(PoseSmootherOptions::Of(Smoothing::kStrong));
  const double speed = 100.0;  // Pixels per second, a slow pan.
  double x = 0.0;
  for (int i = 0; i <= 90; ++i) {
    x = Pixels(Apply(i * kFrame, Sideways(speed * i * kFrame), true));
  }
  const double lag = (speed * 90 * kFrame - x) / speed;
  EXPECT_GT(lag, 0.0);
  EXPECT_LT(lag, 0.010);
}

TEST_F(PoseSmootherTest, TheFilterNeverHoldsBackMoreThanAFewDeviations) {
  PoseSmootherOptions options = PoseSmootherOptions::Of(Smoothing::kStrong);
  options.cutoff_per_speed = 0.0;  // Prevents the speed of the jump from raising the cutoff.
  Make(options);
  Apply(0.0, Sideways(0.0), true);
  const Rigid3 jumped = Sideways(50.0);
  const Twist rest = TwistBetween(Apply(kFrame, jumped, true), jumped);
  const double deviations = std::sqrt(rest.dot(covariance_.inverse() * rest) / 6.0);
  EXPECT_NEAR(deviations, PoseSmootherOptions().most_deviations, 1e-6);
}

TEST_F(PoseSmootherTest, TheFrameRateDoesNotMatter) {
  std::vector<double> arrived;
  for (const int rate : {30, 60, 120}) {
    PoseSmootherOptions options = PoseSmootherOptions::Of(Smoothing::kStrong);
    options.cutoff_per_speed = 0.0;  // A plain low-pass, whose response is known.
    options.most_deviations = 1e9;
    Make(options);
    for (int i = 0; i <= rate / 10; ++i) {
      arrived.push_back(Pixels(Apply(static_cast<double>(i) / rate, Sideways(i > 0), true)));
    }
    EXPECT_NEAR(arrived.back(), 1.0 - std::exp(-2.0 * M_PI * 0.1), 1e-9) << rate;
  }
}

TEST_F(PoseSmootherTest, WithoutACovarianceTheFilterLetsPosesPass) {
  Make(PoseSmootherOptions::Of(Smoothing::kStrong));
  covariance_.setZero();
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(Pixels(Apply(i * kFrame, Sideways(i % 2), true)), Pixels(Sideways(i % 2)));
  }
}

}  // namespace
}  // namespace lararium::vision
