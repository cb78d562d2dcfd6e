#include "shared/vision/pose_refinement.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "shared/core/random.h"
#include "tests/support/synthetic_world.h"

namespace lararium::vision {
namespace {

using geometry::Rigid3;

constexpr double kRefinedFocal = 560.0;

Rigid3 SomePose(Random& random) {
  return {Eigen::Quaterniond{random.Normal(), random.Normal(), random.Normal(), random.Normal()}
              .normalized(),
          {random.Normal(), random.Normal(), random.Normal()}};
}

// Matches of points in front of the camera, with noise.
std::vector<PoseMatch> Matches(const Rigid3& pose, int count, double noise_px, Random& random) {
  std::vector<PoseMatch> matches;
  for (int i = 0; i < count; ++i) {
    const double z = random.Uniform(2.0, 6.0);
    const Eigen::Vector3d p{z * random.Uniform(-0.5, 0.5), z * random.Uniform(-0.4, 0.4), z};
    PoseMatch match;
    match.point = pose.Inverse() * p;
    match.plane = p.head<2>() / p.z() +
                  noise_px / kRefinedFocal * Eigen::Vector2d{random.Normal(), random.Normal()};
    matches.push_back(match);
  }
  return matches;
}

Vector6d Difference(const Rigid3& estimate, const Rigid3& truth) {
  const Rigid3 motion = estimate * truth.Inverse();
  Vector6d difference;
  difference << geometry::VectorFromRotation(motion.rotation), motion.translation;
  return difference;
}

Vector6d SmallStep(double size, Random& random) {
  Vector6d step;
  for (int i = 0; i < 6; ++i) {
    step[i] = size * random.Normal();
  }
  return step;
}

TEST(PlaneResidual, JacobianIsThatOfDifferences) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Rigid3 pose = SomePose(random);
    const PoseMatch match = Matches(pose, 1, 3.0, random)[0];
    Eigen::Vector2d residual;
    Matrix26d jacobian;
    ASSERT_TRUE(PlaneResidual(pose, match, residual, &jacobian));
    for (int k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-6;
      Eigen::Vector2d plus;
      Eigen::Vector2d minus;
      ASSERT_TRUE(PlaneResidual(Moved(pose, kStep * Vector6d::Unit(k)), match, plus, nullptr));
      ASSERT_TRUE(PlaneResidual(Moved(pose, -kStep * Vector6d::Unit(k)), match, minus, nullptr));
      EXPECT_LT((jacobian.col(k) - (plus - minus) / (2.0 * kStep)).norm(), 1e-6);
    }
  }
}

TEST(PlaneResidual, RefusesPointsBehindTheCamera) {
  PoseMatch match;
  match.point = {0.0, 0.0, -1.0};
  match.plane = {0.0, 0.0};
  Eigen::Vector2d residual;
  EXPECT_FALSE(PlaneResidual(Rigid3(), match, residual, nullptr));
}

TEST(PoseRefiner, IsExactWithoutNoise) {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Rigid3 truth = SomePose(random);
    const auto matches = Matches(truth, 40, 0.0, random);
    RefinedPose refined;
    PoseRefiner().Refine(matches, {kRefinedFocal, 2.0}, Moved(truth, SmallStep(1e-3, random)),
                         refined);
    EXPECT_EQ(refined.inliers.size(), matches.size());
    EXPECT_LT(Difference(refined.camera_from_map, truth).norm(), 1e-9);
  }
}

TEST(PoseRefiner, LeavesOutliersAlone) {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Rigid3 truth = SomePose(random);
    auto matches = Matches(truth, 60, 0.3, random);
    const auto elsewhere = Matches(truth, 90, 0.0, random);
    for (size_t k = 0; k < elsewhere.size(); ++k) {
      matches.push_back(elsewhere[k]);
      matches.back().plane = elsewhere[(k + 1) % elsewhere.size()].plane;
    }
    RefinedPose refined;
    PoseRefiner().Refine(matches, {kRefinedFocal, 2.0}, Moved(truth, SmallStep(2e-3, random)),
                         refined);
    const auto right = std::count_if(refined.inliers.begin(), refined.inliers.end(),
                                     [](uint32_t k) { return k < 60; });
    EXPECT_GE(right, 58);
    EXPECT_LE(refined.inliers.size() - right, 4u);
    EXPECT_LT(Difference(refined.camera_from_map, truth).norm(), 0.01);
  }
}

// For normal noise, the normalised squared error has a chi-square distribution with six degrees of
// freedom, whose mean is 6, if the estimate is efficient and its covariance is correct.
TEST(PoseRefiner, IsAsPreciseAsItsCovarianceSays) {
  Random random(4);
  double sum = 0.0;
  double noise_sum = 0.0;
  constexpr int kTrials = 300;
  for (int i = 0; i < kTrials; ++i) {
    const Rigid3 truth = SomePose(random);
    const auto matches = Matches(truth, 100, 0.3, random);
    RefinedPose refined;
    PoseRefiner().Refine(matches, {kRefinedFocal, 2.0}, Moved(truth, SmallStep(1e-3, random)),
                         refined);
    const Vector6d error = Difference(refined.camera_from_map, truth);
    sum += error.dot(refined.covariance.ldlt().solve(error));
    noise_sum += refined.noise_px;
  }
  EXPECT_NEAR(noise_sum / kTrials, 0.3, 0.02);
  EXPECT_NEAR(sum / kTrials, 6.0, 1.5);
}

TEST(PoseRefiner, WeighsMatchesByTheirSigma) {
  Random random(5);
  double weighted = 0.0;
  double equal = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Rigid3 truth = SomePose(random);
    auto matches = Matches(truth, 30, 0.1, random);
    auto coarse = Matches(truth, 90, 1.0, random);
    for (PoseMatch& match : coarse) {
      match.sigma_px = 10.0;
    }
    matches.insert(matches.end(), coarse.begin(), coarse.end());
    RefinedPose refined;
    PoseRefiner().Refine(matches, {kRefinedFocal, 4.0}, truth, refined);
    weighted += Difference(refined.camera_from_map, truth).norm();
    for (PoseMatch& match : matches) {
      match.sigma_px = 1.0;
    }
    PoseRefiner().Refine(matches, {kRefinedFocal, 4.0}, truth, refined);
    equal += Difference(refined.camera_from_map, truth).norm();
  }
  EXPECT_LT(weighted, 0.9 * equal);
}

TEST(PoseRefiner, SurvivesTooFewMatches) {
  Random random(6);
  for (const int count : {0, 1, 2}) {
    const auto matches = Matches(Rigid3(), count, 0.0, random);
    RefinedPose refined;
    PoseRefiner().Refine(matches, {kRefinedFocal, 2.0}, Rigid3(), refined);
    EXPECT_EQ(refined.inliers.size(), static_cast<size_t>(count));
    EXPECT_EQ(refined.covariance.norm(), 0.0);
  }
}

}  // namespace
}  // namespace lararium::vision
