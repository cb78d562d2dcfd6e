#include "shared/vision/patch_pose.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "shared/core/random.h"

namespace lararium::vision {
namespace {

using geometry::Rigid3;

constexpr double kFocal = 500.0;
const geometry::CameraModel kPatchCamera{640, 480, kFocal, kFocal, 319.5, 239.5};

const Rigid3 kTruth{geometry::RotationFromVector({0.1, -0.2, 0.05}), {0.1, 0.2, 4.0}};

// Makes matches, half of which are localised along one axis only.
std::vector<PatchMatch> MakeMatches(int count, double noise_px, double outliers, uint64_t seed) {
  Random random(seed);
  std::vector<PatchMatch> matches;
  for (int i = 0; i < count; ++i) {
    PatchMatch& match = matches.emplace_back();
    match.point = {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
    const double vague = i % 2 == 0 ? 1.0 : 30.0;
    match.whitening << 1.0, 0.0, 0.0, 1.0 / vague;
    match.pixel = *kPatchCamera.Project(kTruth * match.point);
    match.pixel += noise_px * Eigen::Vector2d{random.Normal(), vague * random.Normal()};
    if (random.Uniform() < outliers) {
      match.pixel +=
          kFocal * Eigen::Vector2d{random.Uniform(-0.05, 0.05), random.Uniform(0.01, 0.05)};
    }
  }
  return matches;
}

Vector6d Difference(const Rigid3& estimate) {
  const Rigid3 motion = estimate * kTruth.Inverse();
  Vector6d difference;
  difference << geometry::VectorFromRotation(motion.rotation), motion.translation;
  return difference;
}

CameraPrior KnownPrior() { return {ExactCamera(kPatchCamera)}; }

const PosedCamera kStart{
    Rigid3{geometry::RotationFromVector({0.01, 0.01, -0.01}), {0.02, 0.0, 0.03}} * kTruth,
    ExactCamera(kPatchCamera)};

TEST(EstimatePatchPose, IsExactWithoutNoise) {
  PatchPose pose;
  ASSERT_TRUE(EstimatePatchPose(MakeMatches(50, 0.0, 0.0, 1), KnownPrior(), kStart, 1e-6, pose));
  EXPECT_LT(Difference(pose.posed.camera_from_map).norm(), 1e-8);
  EXPECT_EQ(pose.inliers, 50);
}

TEST(EstimatePatchPose, LeavesOutliersOut) {
  PatchPose pose;
  ASSERT_TRUE(EstimatePatchPose(MakeMatches(200, 0.1, 0.3, 2), KnownPrior(), kStart, 0.01, pose));
  EXPECT_LT(Difference(pose.posed.camera_from_map).norm(), 2e-3);
  EXPECT_GT(pose.inliers, 120);
  EXPECT_LT(pose.inliers, 165);
}

TEST(EstimatePatchPose, CovarianceForetellsTheScatter) {
  double sum = 0.0;
  constexpr int kRuns = 150;
  for (int run = 0; run < kRuns; ++run) {
    PatchPose pose;
    ASSERT_TRUE(
        EstimatePatchPose(MakeMatches(100, 0.2, 0.0, 100 + run), KnownPrior(), kStart, 0.01, pose));
    const Vector6d d = Difference(pose.posed.camera_from_map);
    sum += d.dot(pose.covariance.topLeftCorner<6, 6>().inverse() * d) / 6.0;
  }
  EXPECT_NEAR(sum / kRuns, 1.0, 0.25);
}

TEST(EstimatePatchPose, WantsFourMatches) {
  PatchPose pose;
  EXPECT_FALSE(EstimatePatchPose(MakeMatches(3, 0.0, 0.0, 1), KnownPrior(), kStart, 1e-6, pose));
}

}  // namespace
}  // namespace lararium::vision
