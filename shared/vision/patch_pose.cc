#include "shared/vision/patch_pose.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lararium::vision {
namespace {

using geometry::Rigid3;

constexpr int kPoseIterations = 10;
constexpr double kTukey2 = 4.685 * 4.685;  // 95 % efficiency for normal noise.
constexpr size_t kSampleMost = 512;        // Maximum number of squares sampled for the median.

// Computes the matches' points in the camera frame and the squares of their whitened residuals,
// which are infinite behind the camera.
void FindSquares(std::span<const PatchMatch> matches, PatchPose& pose) {
  const Eigen::Matrix3d rotation = pose.camera_from_map.rotation.toRotationMatrix();
  const Eigen::Vector3d& translation = pose.camera_from_map.translation;
  for (size_t i = 0; i < matches.size(); ++i) {
    pose.in_camera[i].noalias() = rotation * matches[i].point;
    pose.in_camera[i] += translation;
    Eigen::Vector2d residual;
    const bool seen = PlaneResidual(pose.in_camera[i], matches[i].plane, residual, nullptr);
    pose.squares[i] = seen ? (matches[i].whitening * residual).squaredNorm()
                           : std::numeric_limits<double>::infinity();
  }
}

// Standard deviation along one axis from the median of the squares, which is 2 ln 2 sigma^2 for a
// two-dimensional normal distribution.
double ScaleOf(std::span<const double> squares) {
  std::array<double, kSampleMost> sample{};
  const size_t stride = (squares.size() + kSampleMost - 1) / kSampleMost;
  size_t count = 0;
  for (size_t i = 0; i < squares.size(); i += stride) {
    sample[count++] = squares[i];
  }
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(sample.begin(), middle, sample.begin() + static_cast<std::ptrdiff_t>(count));
  return std::sqrt(*middle / (2.0 * std::log(2.0)));
}

}  // namespace

bool EstimatePatchPose(std::span<const PatchMatch> matches,
                       const Rigid3& start,
                       double least_scale,
                       PatchPose& pose) {
  pose.camera_from_map = start;
  pose.squares.resize(matches.size());
  pose.in_camera.resize(matches.size());
  pose.inliers = 0;
  pose.covariance.setZero();
  if (matches.size() < 4) {
    return false;
  }
  Matrix6d information;
  for (int iteration = 0;; ++iteration) {
    FindSquares(matches, pose);
    pose.scale = std::max(ScaleOf(pose.squares), least_scale);
    if (!std::isfinite(pose.scale)) {
      return false;
    }
    const double limit = kTukey2 * pose.scale * pose.scale;
    information.setZero();
    Vector6d right = Vector6d::Zero();
    for (size_t i = 0; i < matches.size(); ++i) {
      if (pose.squares[i] >= limit) {
        continue;
      }
      Eigen::Vector2d residual;
      Matrix26d jacobian;
      PlaneResidual(pose.in_camera[i], matches[i].plane, residual, &jacobian);
      const double root = 1.0 - pose.squares[i] / limit;
      const Eigen::Matrix2d whitening = root * matches[i].whitening;
      const Matrix26d whitened = whitening * jacobian;
      information.noalias() += whitened.transpose() * whitened;
      right.noalias() -= whitened.transpose() * (whitening * residual);
    }
    Matrix6d damped = information;
    damped.diagonal() *= 1.0 + 1e-9;
    const Vector6d step = damped.ldlt().solve(right);
    if (!step.allFinite()) {
      return false;
    }
    // The step is less than a thousandth of a standard deviation.
    const bool converged = right.dot(step) < 1e-6 * pose.scale * pose.scale;
    if (converged || iteration >= kPoseIterations) {
      break;
    }
    pose.camera_from_map = Moved(pose.camera_from_map, step);
  }
  const double scale2 = pose.scale * pose.scale;
  for (double& square : pose.squares) {
    square /= scale2;
    pose.inliers += square < kInlierSquare ? 1 : 0;
  }
  const Matrix6d inverse = information.inverse();
  if (!inverse.allFinite()) {
    return false;
  }
  pose.covariance = scale2 * inverse;
  return true;
}

}  // namespace lararium::vision
