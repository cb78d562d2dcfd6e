#include "shared/vision/pose_refinement.h"

#include <Eigen/LU>

#include "shared/vision/robust_refinement.h"

namespace lararium::vision {
namespace {

using geometry::Rigid3;

// The pose of a known camera.
struct PoseProblem {
  static constexpr int kSize = 6;
  using State = Rigid3;

  double focal;

  bool Residual(const Rigid3& pose,
                const PoseMatch& match,
                Eigen::Vector2d& residual,
                Matrix26d* jacobian) const {
    if (!PlaneResidual(pose, match, residual, jacobian)) {
      return false;
    }
    const double scale = focal / match.sigma_px;
    residual *= scale;
    if (jacobian != nullptr) {
      *jacobian *= scale;
    }
    return true;
  }
  static Rigid3 Moved(const Rigid3& pose, const Vector6d& step) {
    return vision::Moved(pose, step);
  }
  static double PriorCost(const Rigid3& /*pose*/) { return 0.0; }
  static void AddPrior(const Rigid3& /*pose*/, double, Matrix6d&, Vector6d&) {}
};

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
  const PoseProblem problem{options.focal};
  Rigid3 pose = start;
  Matrix6d information;
  RobustRefinement(problem, matches, options.inlier_threshold_px, squares_)
      .Run(3, pose, refined.inliers, refined.noise_px, information);
  refined.camera_from_map = pose;
  const Matrix6d inverse = information.inverse();
  refined.covariance = refined.noise_px > 0.0 && inverse.allFinite()
                           ? Matrix6d(refined.noise_px * refined.noise_px * inverse)
                           : Matrix6d::Zero();
}

}  // namespace lararium::vision
