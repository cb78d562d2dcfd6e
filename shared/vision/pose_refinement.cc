#include "shared/vision/pose_refinement.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace lararium::vision {
namespace {

using geometry::Rigid3;

// Squared residual in pixels over sigma_px; infinite behind the camera.
double NormalisedSquare(const Rigid3& pose, const PoseMatch& match, double focal) {
  Eigen::Vector2d residual;
  if (!PlaneResidual(pose, match, residual, nullptr)) {
    return std::numeric_limits<double>::infinity();
  }
  return residual.squaredNorm() * (focal * focal) / (match.sigma_px * match.sigma_px);
}

// Cauchy's loss with scale c of a square s: c^2 / 2 log(1 + s / c^2), and twice its derivative by
// s.
double Loss(double square, double c2) { return 0.5 * c2 * std::log1p(square / c2); }
double Weight(double square, double c2) { return 1.0 / (1.0 + square / c2); }

double TotalLoss(const Rigid3& pose,
                 std::span<const PoseMatch> matches,
                 std::span<const uint32_t> chosen,
                 double focal,
                 double c2) {
  double sum = 0.0;
  for (const uint32_t i : chosen) {
    sum += Loss(NormalisedSquare(pose, matches[i], focal), c2);
  }
  return sum;
}

struct NormalEquations {
  Matrix6d matrix = Matrix6d::Zero();
  Vector6d right = Vector6d::Zero();
};

NormalEquations Linearise(const Rigid3& pose,
                          std::span<const PoseMatch> matches,
                          std::span<const uint32_t> chosen,
                          double focal,
                          double c2) {
  NormalEquations normal;
  for (const uint32_t i : chosen) {
    Eigen::Vector2d residual;
    Matrix26d jacobian;
    if (!PlaneResidual(pose, matches[i], residual, &jacobian)) {
      continue;
    }
    const double scale = focal / matches[i].sigma_px;
    residual *= scale;
    jacobian *= scale;
    const double weight = Weight(residual.squaredNorm(), c2);
    normal.matrix.noalias() += weight * jacobian.transpose() * jacobian;
    normal.right.noalias() -= weight * jacobian.transpose() * residual;
  }
  return normal;
}

// Minimises the loss by the Levenberg-Marquardt method.
Rigid3 Minimise(Rigid3 pose,
                std::span<const PoseMatch> matches,
                std::span<const uint32_t> chosen,
                double focal,
                double scale) {
  constexpr int kMaxIterations = 20;
  const double c2 = scale * scale;
  double damping = 1e-4;
  double loss = TotalLoss(pose, matches, chosen, focal, c2);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const NormalEquations normal = Linearise(pose, matches, chosen, focal, c2);
    Matrix6d damped = normal.matrix;
    damped.diagonal() *= 1.0 + damping;
    const Vector6d step = damped.ldlt().solve(normal.right);
    if (!step.allFinite()) {
      break;
    }
    const Rigid3 moved = Moved(pose, step);
    const double moved_loss = TotalLoss(moved, matches, chosen, focal, c2);
    if (moved_loss < loss) {
      const bool converged = loss - moved_loss < 1e-9 * loss;
      pose = moved;
      loss = moved_loss;
      damping = std::max(damping * 0.1, 1e-9);
      if (converged) {
        break;
      }
    } else {
      damping *= 10.0;
      if (damping > 1e6) {
        break;
      }
    }
  }
  return pose;
}

// Selects the matches whose residual is below threshold_px * min(sigma_px, kMostSigma), so that
// uncertain matches get no more than kMostSigma times the threshold.
void SelectInliers(const Rigid3& pose,
                   std::span<const PoseMatch> matches,
                   double focal,
                   double threshold_px,
                   std::vector<uint32_t>& inliers) {
  constexpr double kMostSigma = 2.0;
  inliers.clear();
  for (size_t i = 0; i < matches.size(); ++i) {
    const double sigma = matches[i].sigma_px;
    const double limit = threshold_px * std::min(1.0, kMostSigma / sigma);
    if (NormalisedSquare(pose, matches[i], focal) < limit * limit) {
      inliers.push_back(static_cast<uint32_t>(i));
    }
  }
}

// Standard deviation along one axis from the median distance, which is 1.1774 sigma for a
// two-dimensional normal distribution. squares is working memory.
double NoiseOf(const Rigid3& pose,
               std::span<const PoseMatch> matches,
               std::span<const uint32_t> chosen,
               double focal,
               std::vector<double>& squares) {
  squares.clear();
  for (const uint32_t i : chosen) {
    squares.push_back(NormalisedSquare(pose, matches[i], focal));
  }
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return std::sqrt(*middle) / 1.1774;
}

}  // namespace

bool PlaneResidual(const Rigid3& camera_from_map,
                   const PoseMatch& match,
                   Eigen::Vector2d& residual,
                   Matrix26d* jacobian) {
  return PlaneResidual(camera_from_map * match.point, match.plane, residual, jacobian);
}

Rigid3 Moved(const Rigid3& camera_from_map, const Vector6d& step) {
  const Eigen::Vector3d w = step.head<3>();
  const Rigid3 motion{geometry::RotationFromVector(w), step.tail<3>()};
  return motion * camera_from_map;
}

void PoseRefiner::Refine(std::span<const PoseMatch> matches,
                         const RefinementOptions& options,
                         const Rigid3& start,
                         RefinedPose& refined) {
  // The first pose carries the noise of only three matches, so the threshold starts wide and then
  // narrows.
  constexpr int kRounds = 3;
  constexpr double kWidening[kRounds] = {4.0, 1.5, 1.0};
  constexpr double kLeastNoise = 1e-9;    // Pixels; avoids zero for exact input.
  constexpr double kCauchyScale = 2.385;  // 95 % efficiency for normal noise.
  Rigid3 pose = start;
  std::vector<uint32_t>& inliers = refined.inliers;
  double scale = options.inlier_threshold_px;
  refined.noise_px = 0.0;
  refined.covariance.setZero();
  for (const double widening : kWidening) {
    SelectInliers(pose, matches, options.focal, widening * options.inlier_threshold_px, inliers);
    if (inliers.size() < 3) {
      break;
    }
    pose = Minimise(pose, matches, inliers, options.focal, scale);
    refined.noise_px =
        std::max(NoiseOf(pose, matches, inliers, options.focal, squares_), kLeastNoise);
    scale = std::min(kCauchyScale * refined.noise_px, options.inlier_threshold_px);
  }
  SelectInliers(pose, matches, options.focal, options.inlier_threshold_px, inliers);
  refined.camera_from_map = pose;
  if (inliers.size() >= 3) {
    const NormalEquations normal = Linearise(pose, matches, inliers, options.focal, scale * scale);
    const Matrix6d inverse = normal.matrix.inverse();
    if (inverse.allFinite()) {
      refined.covariance = refined.noise_px * refined.noise_px * inverse;
    }
  } else {
    refined.noise_px = 0.0;
  }
}

}  // namespace lararium::vision
