#include "shared/vision/camera_refinement.h"

#include "shared/vision/robust_refinement.h"

namespace lararium::vision {
namespace {

struct CameraProblem {
  static constexpr int kSize = kMostJoint;
  using State = PosedCamera;

  const CameraEstimate& prior;
  CameraMatrix information;

  static bool Residual(const PosedCamera& posed,
                       const PoseMatch& match,
                       Eigen::Vector2d& residual,
                       Eigen::Matrix<double, 2, kSize>* jacobian) {
    if (!PixelResidual<kSize>(posed.camera, posed.camera_from_map * match.point, nullptr,
                              match.pixel, residual, jacobian)) {
      return false;
    }
    residual /= match.sigma_px;
    if (jacobian != nullptr) {
      *jacobian /= match.sigma_px;
    }
    return true;
  }
  static PosedCamera Moved(const PosedCamera& posed, const JointVector<kSize>& step) {
    return {vision::Moved(posed.camera_from_map, step.head<6>()),
            Changed(posed.camera, step.tail<kCameraParameters>())};
  }
  double PriorCost(const PosedCamera& posed) const {
    const CameraVector off = Difference(prior, posed.camera);
    return 0.5 * off.dot(information * off);
  }
  void AddPrior(const PosedCamera& posed,
                double weight,
                JointMatrix<kSize>& matrix,
                JointVector<kSize>& right) const {
    const CameraVector off = Difference(prior, posed.camera);
    matrix.bottomRightCorner<kCameraParameters, kCameraParameters>() += weight * information;
    right.tail<kCameraParameters>() -= weight * (information * off);
  }
};

}  // namespace

void CameraRefiner::Refine(std::span<const PoseMatch> matches,
                           double inlier_threshold_px,
                           const PosedCamera& start,
                           const CameraEstimate& prior,
                           RefinedCamera& refined) {
  const CameraProblem problem{prior, Information(prior)};
  PosedCamera posed = start;
  RobustRefinement(problem, matches, inlier_threshold_px, squares_)
      .Run(7, posed, refined.inliers, refined.noise_px, refined.information);
  refined.posed = posed;
}

}  // namespace lararium::vision
