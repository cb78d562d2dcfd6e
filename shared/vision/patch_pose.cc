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
template <int N>
void FindSquares(std::span<const PatchMatch> matches, FrameMotion motion, PatchPose& pose) {
  const Rigid3& camera_from_map = pose.posed.camera_from_map;
  const Eigen::Matrix3d rotation = camera_from_map.rotation.toRotationMatrix();
  for (size_t i = 0; i < matches.size(); ++i) {
    pose.in_camera[i].noalias() = rotation * matches[i].point;
    pose.in_camera[i] += camera_from_map.translation;
    Eigen::Vector2d residual;
    const bool seen = PixelResidual<N>(pose.posed.camera, pose.in_camera[i], motion,
                                       matches[i].pixel, residual, nullptr);
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

// Estimates the pose and the first N - 6 parameters of the camera.
template <int N>
bool Estimate(std::span<const PatchMatch> matches,
              const CameraPrior& prior,
              double least_scale,
              PatchPose& pose) {
  const CameraMatrix prior_information = Information(prior.camera);
  JointMatrix<N> information;
  for (int iteration = 0;; ++iteration) {
    FindSquares<N>(matches, prior.motion, pose);
    pose.scale = std::max(ScaleOf(pose.squares), least_scale);
    if (!std::isfinite(pose.scale)) {
      return false;
    }
    const double limit = kTukey2 * pose.scale * pose.scale;
    information.setZero();
    JointVector<N> right = JointVector<N>::Zero();
    for (size_t i = 0; i < matches.size(); ++i) {
      if (pose.squares[i] >= limit) {
        continue;
      }
      Eigen::Vector2d residual;
      Eigen::Matrix<double, 2, N> jacobian;
      PixelResidual<N>(pose.posed.camera, pose.in_camera[i], prior.motion, matches[i].pixel,
                       residual, &jacobian);
      const double root = 1.0 - pose.squares[i] / limit;
      const Eigen::Matrix2d whitening = root * matches[i].whitening;
      const Eigen::Matrix<double, 2, N> whitened = whitening * jacobian;
      information.noalias() += whitened.transpose() * whitened;
      right.noalias() -= whitened.transpose() * (whitening * residual);
    }
    if constexpr (N > 6) {
      const double weight = prior.shared_errors * pose.scale * pose.scale;
      const CameraVector off = Difference(prior.camera, pose.posed.camera);
      information.template bottomRightCorner<N - 6, N - 6>() +=
          weight * prior_information.topLeftCorner<N - 6, N - 6>();
      right.template tail<N - 6>() -=
          weight * (prior_information.topLeftCorner<N - 6, N - 6>() * off.head<N - 6>());
    }
    JointMatrix<N> damped = information;
    damped.diagonal() *= 1.0 + 1e-9;
    const JointVector<N> step = BoundedMatrix(damped).ldlt().solve(BoundedVector(right));
    if (!step.allFinite()) {
      return false;
    }
    // The step is less than a thousandth of a standard deviation.
    const bool converged = right.dot(step) < 1e-6 * pose.scale * pose.scale;
    if (converged || iteration >= kPoseIterations) {
      break;
    }
    pose.posed.camera_from_map = Moved(pose.posed.camera_from_map, step.template head<6>());
    if constexpr (N > 6) {
      CameraVector change = CameraVector::Zero();
      change.head<N - 6>() = step.template tail<N - 6>();
      pose.posed.camera = Changed(pose.posed.camera, change);
    }
  }
  const double scale2 = pose.scale * pose.scale;
  for (double& square : pose.squares) {
    square /= scale2;
    pose.inliers += square < kInlierSquare ? 1 : 0;
  }
  const JointMatrix<N> inverse = BoundedMatrix(information).inverse();
  if (!inverse.allFinite()) {
    return false;
  }
  pose.covariance.topLeftCorner<N, N>() = prior.shared_errors * scale2 * inverse;
  return true;
}

}  // namespace

bool EstimatePatchPose(std::span<const PatchMatch> matches,
                       const CameraPrior& prior,
                       const PosedCamera& start,
                       double least_scale,
                       PatchPose& pose) {
  pose.posed = start;
  pose.squares.resize(matches.size());
  pose.in_camera.resize(matches.size());
  pose.inliers = 0;
  pose.covariance.setZero();
  if (matches.size() < 4) {
    return false;
  }
  const int unknown = prior.camera.Unknown();
  return unknown == 0 ? Estimate<6>(matches, prior, least_scale, pose)
         : unknown <= kShutterParameters
             ? Estimate<6 + kShutterParameters>(matches, prior, least_scale, pose)
             : Estimate<kMostJoint>(matches, prior, least_scale, pose);
}

}  // namespace lararium::vision
