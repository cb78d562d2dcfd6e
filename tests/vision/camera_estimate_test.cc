#include "shared/vision/camera_estimate.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "shared/core/random.h"
#include "shared/vision/camera_refinement.h"
#include "shared/vision/patch_pose.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

const CameraModel kPhone{1280, 720, 880.0, 880.0, 636.0, 363.0, 0.05, -0.07, 0.001, -0.0005};

CameraMatrix Variances(double readout, double focal, double centre, double radial) {
  CameraVector deviations;
  deviations << readout, readout, 0.0, 0.0, 0.0, focal, centre, centre, radial, radial;
  return deviations.cwiseAbs2().asDiagonal();
}

Eigen::Vector3d PointInView(Random& random) {
  const double z = random.Uniform(2.0, 6.0);
  return {z * random.Uniform(-0.6, 0.6), z * random.Uniform(-0.35, 0.35), z};
}

// The pixel of a point that is seen while the shutter rolls.
Eigen::Vector2d RollingPixel(const CameraEstimate& camera,
                             const Eigen::Vector3d& in_camera,
                             FrameMotion motion) {
  Eigen::Vector2d pixel = *camera.model.Project(in_camera);
  for (int i = 0; i < 20; ++i) {
    pixel = *camera.model.Project(AtTimeOf(camera.TimeOf(pixel), in_camera, motion));
  }
  return pixel;
}

TEST(PixelResidual, JacobianIsThatOfDifferences) {
  Random random(1);
  Vector6d motion;
  motion << 0.02, -0.03, 0.01, 0.01, 0.02, -0.01;
  CameraEstimate camera = ExactCamera(kPhone);
  camera.readout = {0.3, 0.7};
  camera.turning = {0.01, 0.005, -0.02};
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d point = PointInView(random);
    const Eigen::Vector2d observed{random.Uniform(0, 1280), random.Uniform(0, 720)};
    Eigen::Vector2d residual;
    Eigen::Matrix<double, 2, kMostJoint> jacobian;
    ASSERT_TRUE(PixelResidual<kMostJoint>(camera, point, &motion, observed, residual, &jacobian));
    for (int k = 0; k < kMostJoint; ++k) {
      constexpr double kStep = 1e-6;
      std::array<Eigen::Vector2d, 2> ends;
      for (const int side : {0, 1}) {
        const double step = side == 0 ? -kStep : kStep;
        Vector6d move = Vector6d::Zero();
        CameraVector change = CameraVector::Zero();
        (k < 6 ? move[k] : change[k - 6]) = step;
        const Eigen::Vector3d moved = Moved(Rigid3(), move) * point;
        ASSERT_TRUE(PixelResidual<kMostJoint>(Changed(camera, change), moved, &motion, observed,
                                              ends[side], nullptr));
      }
      const Eigen::Vector2d slope = (ends[1] - ends[0]) / (2.0 * kStep);
      EXPECT_LT((jacobian.col(k) - slope).norm(), 1e-5 * slope.norm() + 1e-3) << k;
    }
  }
}

TEST(Changed, IsUndoneByTheDifference) {
  const CameraEstimate camera = ExactCamera(kPhone);
  CameraVector step;
  step << 0.1, -0.2, 0.01, -0.03, 0.02, 0.05, 3.0, -4.0, 0.01, -0.02;
  EXPECT_LT((Difference(camera, Changed(camera, step)) - step).norm(), 1e-12);
}

TEST(Information, IsTheInverseOfWhatIsUncertain) {
  CameraEstimate camera = ExactCamera(kPhone);
  EXPECT_EQ(camera.Unknown(), 0);
  camera.covariance = Variances(0.5, 0.0, 0.0, 0.0);
  EXPECT_EQ(camera.Unknown(), kTurnX);
  camera.covariance = Variances(0.5, 0.1, 5.0, 0.05);
  camera.covariance.diagonal().segment<3>(kTurnX).setConstant(1e-4);
  camera.covariance(kFocal, kRadial1) = camera.covariance(kRadial1, kFocal) = 0.002;
  EXPECT_EQ(camera.Unknown(), kCameraParameters);
  EXPECT_LT((Information(camera) * camera.covariance - CameraMatrix::Identity()).norm(), 1e-9);
}

// --- Estimating the camera with the pose

const Rigid3 kPose{geometry::RotationFromVector({0.2, -0.1, 0.05}), {0.3, 0.1, 0.5}};

TEST(CameraRefiner, FindsTheIntrinsicsThatItIsNotTold) {
  Random random(3);
  double focal_error = 0.0;
  double normalised = 0.0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<PoseMatch> matches;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d in_camera = PointInView(random);
      PoseMatch match;
      match.point = kPose.Inverse() * in_camera;
      match.pixel =
          *kPhone.Project(in_camera) + 0.5 * Eigen::Vector2d{random.Normal(), random.Normal()};
      if (i % 5 == 0) {
        match.pixel += Eigen::Vector2d{random.Uniform(20, 80), random.Uniform(-80, 80)};
      }
      matches.push_back(match);
    }
    CameraEstimate prior =
        ExactCamera({1280, 720, 1000.0, 1000.0, 639.5, 359.5, 0.0, 0.0, kPhone.p1, kPhone.p2});
    prior.covariance = Variances(0.5, 0.7, 12.0, 0.1);
    PosedCamera start{kPose, prior};
    start.camera.model.fx = start.camera.model.fy = 900.0;
    RefinedCamera refined;
    CameraRefiner().Refine(matches, 2.0, start, prior, refined);
    EXPECT_NEAR(static_cast<double>(refined.inliers.size()), 160.0, 6.0);
    JointMatrix<kMostJoint> information =
        refined.information / (refined.noise_px * refined.noise_px);
    information.bottomRightCorner<kCameraParameters, kCameraParameters>() += Information(prior);
    const JointMatrix<kMostJoint> covariance = information.inverse();
    const double off = std::log(refined.posed.camera.model.Focal() / 880.0);
    focal_error += off * off / kRuns;
    normalised += off * off / covariance(6 + kFocal, 6 + kFocal) / kRuns;
  }
  EXPECT_LT(std::sqrt(focal_error), 0.01);
  EXPECT_NEAR(normalised, 1.0, 0.5);
}

// Matches of patches that are seen by a rolling shutter.
std::vector<PatchMatch> RollingMatches(const CameraEstimate& truth,
                                       FrameMotion motion,
                                       double noise_px,
                                       Random& random) {
  std::vector<PatchMatch> matches;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d in_camera = PointInView(random);
    PatchMatch& match = matches.emplace_back();
    match.point = kPose.Inverse() * in_camera;
    match.pixel = RollingPixel(truth, in_camera, motion) +
                  noise_px * Eigen::Vector2d{random.Normal(), random.Normal()};
  }
  return matches;
}

double PoseDistance(const Rigid3& a, const Rigid3& b) {
  return a.rotation.angularDistance(b.rotation) + (a.translation - b.translation).norm();
}

TEST(EstimatePatchPose, FindsTheReadoutTimeOfACameraThatTurns) {
  Random random(5);
  Vector6d motion;
  motion << 0.01, 0.03, -0.01, 0.005, -0.004, 0.003;
  for (const Eigen::Vector2d& readout :
       {Eigen::Vector2d(0.0, 0.8), Eigen::Vector2d(-0.8, 0.0), Eigen::Vector2d(0.0, 0.0)}) {
    CameraEstimate truth = ExactCamera(kPhone);
    truth.readout = readout;
    CameraPrior prior{ExactCamera(kPhone), &motion};
    prior.camera.covariance = Variances(0.5, 0.0, 0.0, 0.0);
    PatchPose pose;
    ASSERT_TRUE(EstimatePatchPose(RollingMatches(truth, &motion, 0.1, random), prior,
                                  {kPose, prior.camera}, 0.01, pose));
    EXPECT_LT((pose.posed.camera.readout - readout).norm(), 0.02) << readout.transpose();
    EXPECT_LT(PoseDistance(pose.posed.camera_from_map, kPose), 2e-3);
    EXPECT_EQ(pose.posed.camera.model, kPhone);  // Known parameters do not change.
    EXPECT_LT(pose.covariance(6 + kReadoutY, 6 + kReadoutY), 0.01 * 0.01);
    // Without a motion nothing is learnt.
    prior.motion = nullptr;
    ASSERT_TRUE(EstimatePatchPose(RollingMatches(truth, nullptr, 0.1, random), prior,
                                  {kPose, prior.camera}, 0.01, pose));
    EXPECT_NEAR(pose.covariance(6 + kReadoutY, 6 + kReadoutY), 0.25, 1e-6);
  }
}

TEST(EstimatePatchPose, LearnsFromTheRowsHowTheCameraTurns) {
  Random random(6);
  Vector6d predicted;
  predicted << 0.01, 0.03, -0.01, 0.005, -0.004, 0.003;
  Vector6d motion = predicted;
  motion.head<3>() += Eigen::Vector3d(-0.006, 0.004, 0.005);
  CameraEstimate truth = ExactCamera(kPhone);
  truth.readout = {0.0, 0.8};
  const std::vector<PatchMatch> matches = RollingMatches(truth, &motion, 0.1, random);
  CameraPrior prior{truth, &predicted};
  prior.camera.covariance.diagonal().segment<3>(kTurnX).setConstant(0.005 * 0.005);
  PatchPose pose;
  ASSERT_TRUE(EstimatePatchPose(matches, prior, {kPose, prior.camera}, 0.01, pose));
  const Eigen::Vector3d off = predicted.head<3>() + pose.posed.camera.turning - motion.head<3>();
  EXPECT_LT(off.norm(), 5e-4);
  const Eigen::Matrix3d covariance = pose.covariance.block<3, 3>(6 + kTurnX, 6 + kTurnX);
  EXPECT_LT(off.dot(covariance.inverse() * off), 16.3);  // 99.9 % quantile
  EXPECT_LT(PoseDistance(pose.posed.camera_from_map, kPose), 1e-3);
  EXPECT_EQ(pose.posed.camera.model, kPhone);  // Known parameters do not change.
  EXPECT_LT((pose.posed.camera.readout - truth.readout).norm(), 1e-6);
}

TEST(EstimatePatchPose, WeighsThePriorOfTheFocalLengthAgainstThePatches) {
  Random random(7);
  const CameraEstimate truth = ExactCamera(kPhone);
  CameraPrior prior{ExactCamera(kPhone)};
  prior.camera.model.fx = prior.camera.model.fy = 890.0;
  PatchPose pose;
  // Held firmly.
  prior.camera.covariance = Variances(0.5, 1e-5, 1e-4, 1e-6);
  ASSERT_TRUE(EstimatePatchPose(RollingMatches(truth, nullptr, 0.1, random), prior,
                                {kPose, prior.camera}, 0.01, pose));
  EXPECT_NEAR(pose.posed.camera.model.fx, 890.0, 1.0);
  // Held loosely.
  prior.camera.covariance = Variances(0.5, 0.05, 5.0, 0.02);
  ASSERT_TRUE(EstimatePatchPose(RollingMatches(truth, nullptr, 0.1, random), prior,
                                {kPose, prior.camera}, 0.01, pose));
  EXPECT_NEAR(pose.posed.camera.model.fx, 880.0, 3.0);
  EXPECT_LT(PoseDistance(pose.posed.camera_from_map, kPose), 0.02);
}

}  // namespace
}  // namespace lararium::vision
