#include "shared/vision/confidence.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "shared/core/random.h"

namespace lararium::vision {
namespace {

const geometry::CameraModel kCamera{
    .width = 640, .height = 480, .fx = 560.0, .fy = 560.0, .cx = 319.5, .cy = 239.5};
constexpr std::array<double, 3> kDepths = {2.0, 3.0, 5.0};

// A covariance like that of a pose: large where rotation and translation compensate each other.
Matrix6d SomeCovariance(Random& random, double scale) {
  Matrix6d root;
  for (int i = 0; i < 36; ++i) {
    root(i) = scale * random.Normal();
  }
  root.bottomRows<3>() *= 3.0;
  return root * root.transpose();
}

// Root mean square registration error of one pose error, computed by projection.
double RegistrationError(const Vector6d& error) {
  double sum = 0.0;
  int count = 0;
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 16; ++column) {
      const Eigen::Vector2d pixel(40.0 * column + 19.5, 40.0 * row + 19.5);
      for (const double depth : kDepths) {
        const Eigen::Vector3d point = depth * kCamera.PlaneFromPixel(pixel).homogeneous();
        const auto moved = kCamera.Project(Moved(geometry::Rigid3(), error) * point);
        sum += (*moved - pixel).squaredNorm();
        ++count;
      }
    }
  }
  return std::sqrt(sum / count);
}

TEST(RegularisedBeta, HasItsClosedForms) {
  for (const double x : {0.0, 1e-6, 0.1, 0.37, 0.5, 0.8, 0.999999, 1.0}) {
    EXPECT_NEAR(RegularisedBeta(1.0, 1.0, x), x, 1e-12);
    EXPECT_NEAR(RegularisedBeta(3.0, 1.0, x), x * x * x, 1e-12);
    EXPECT_NEAR(RegularisedBeta(1.0, 4.0, x), 1.0 - std::pow(1.0 - x, 4), 1e-12);
    EXPECT_NEAR(RegularisedBeta(2.0, 2.0, x), x * x * (3.0 - 2.0 * x), 1e-12);
    EXPECT_NEAR(RegularisedBeta(0.5, 0.5, x), 2.0 / M_PI * std::asin(std::sqrt(x)), 1e-12);
    EXPECT_NEAR(RegularisedBeta(2.5, 400.0, x), 1.0 - RegularisedBeta(400.0, 2.5, 1.0 - x), 1e-12);
  }
}

TEST(RegistrationVariance, IsWhatProjectionsOfDrawnPosesShow) {
  Random random(1);
  const Matrix6d covariance = SomeCovariance(random, 1e-4);
  const Matrix6d root = covariance.llt().matrixL();
  const double expected =
      ComputeRegistrationVariance(kCamera,
                                  {.covariance = WithKnownCamera(covariance), .depths = kDepths})
          .sum;
  double sum = 0.0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    Vector6d normal;
    for (int k = 0; k < 6; ++k) {
      normal[k] = random.Normal();
    }
    sum += std::pow(RegistrationError(root * normal), 2);
  }
  EXPECT_NEAR(sum / kDraws / expected, 1.0, 0.08);
}

TEST(RegistrationVariance, CountsWhatIsNotKnownOfTheMotionWhileTheImageIsRead) {
  PoseEvidence evidence{.depths = {2.0, 2.0, 2.0}};
  evidence.shutter.readout = {0.0, 0.8};
  evidence.shutter.motion[0] = 0.01;
  constexpr double kTurning = 0.004;  // Deviation, radians in a frame time.
  evidence.covariance(6 + kTurnX, 6 + kTurnX) = kTurning * kTurning;
  // About x, a small turning moves the image by fy (1 + y^2) times its angle along y, and by
  // f x y along x; the angle is the turning times the time of the row.
  double sum = 0.0;
  double change_sum = 0.0;
  int count = 0;
  for (int row = 0; row < 480; row += 8) {
    for (int column = 0; column < 640; column += 8) {
      const double x = (column + 3.5 - kCamera.cx) / kCamera.fx;
      const double y = (row + 3.5 - kCamera.cy) / kCamera.fy;
      const double time = 0.8 * (row + 3.5 - 239.5) / 480.0;
      const double moved = std::hypot(kCamera.fy * (1.0 + y * y), kCamera.fx * x * y);
      sum += std::pow(kTurning * time * moved, 2);
      change_sum += std::pow(0.5 * kTurning * (time * time - 0.64 / 12.0) * moved, 2);
      ++count;
    }
  }
  EXPECT_NEAR(ComputeRegistrationVariance(kCamera, evidence).sum / (sum / count), 1.0, 0.1);
  // How the turning changes counts where the motion does not show it.
  evidence.covariance.setZero();
  evidence.turning_change(0, 0) = kTurning * kTurning;
  EXPECT_NEAR(ComputeRegistrationVariance(kCamera, evidence).sum / (change_sum / count), 1.0,
              0.4);  // The rows at which it is computed are few.
  evidence.shutter.readout.setZero();
  EXPECT_EQ(ComputeRegistrationVariance(kCamera, evidence).sum, 0.0);
}

TEST(PoseConfidence, IsTheShareOfDrawnPosesWithinTheLimit) {
  Random random(2);
  for (const double scale : {2e-4, 4e-4, 8e-4, 1.6e-3}) {
    const Matrix6d covariance = SomeCovariance(random, scale);
    const Matrix6d root = covariance.llt().matrixL();
    // With many inliers the covariance is certain.
    const double confidence = PoseConfidence(
        kCamera, {.covariance = WithKnownCamera(covariance), .depths = kDepths, .inliers = 100000});
    int within = 0;
    constexpr int kDraws = 2000;
    for (int i = 0; i < kDraws; ++i) {
      Vector6d normal;
      for (int k = 0; k < 6; ++k) {
        normal[k] = random.Normal();
      }
      within += RegistrationError(root * normal) < 1.0 ? 1 : 0;
    }
    EXPECT_NEAR(confidence, static_cast<double>(within) / kDraws, 0.05) << scale;
  }
}

TEST(PoseConfidence, FallsWithTheCovarianceAndWithFewerInliers) {
  Random random(3);
  const Matrix6d covariance = SomeCovariance(random, 1e-4);
  double last = 1.1;
  for (const double factor : {1.0, 3.0, 10.0, 30.0, 100.0, 1000.0}) {
    const double confidence = PoseConfidence(
        kCamera,
        {.covariance = WithKnownCamera(factor * covariance), .depths = kDepths, .inliers = 50});
    EXPECT_LT(confidence, last);
    last = confidence;
  }
  EXPECT_LT(last, 0.1);
  const Matrix6d fair = 3.0 * covariance;
  EXPECT_GT(PoseConfidence(
                kCamera, {.covariance = WithKnownCamera(fair), .depths = kDepths, .inliers = 500}),
            PoseConfidence(kCamera,
                           {.covariance = WithKnownCamera(fair), .depths = kDepths, .inliers = 5}));
  EXPECT_EQ(PoseConfidence(kCamera,
                           {.covariance = WithKnownCamera(fair), .depths = kDepths, .inliers = 3}),
            0.0);
}

TEST(PoseConfidence, IsCertainOfAnExactPoseAndOfNoneThatIsNotFinite) {
  PoseEvidence evidence{.depths = kDepths, .inliers = 50};
  EXPECT_EQ(PoseConfidence(kCamera, evidence), 1.0);
  evidence.covariance(2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(PoseConfidence(kCamera, evidence), 0.0);
}

}  // namespace
}  // namespace lararium::vision
