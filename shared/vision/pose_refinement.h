#pragma once

// Refines the pose that best explains the matches between an image and the map.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "shared/geometry/transform.h"

namespace lararium::vision {

// A map point and its undistorted position in the image.
struct PoseMatch {
  Eigen::Vector3d point;  // Map frame.
  // Observed position on the camera's plane z = 1.
  Eigen::Vector2d plane = Eigen::Vector2d::Zero();
  double sigma_px = 1.0;  // Relative uncertainty of the position; 1 for the finest features.
  // Observed raw pixel. Only for a camera that is estimated with the pose, in place of `plane`.
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

// Projection of the point on the plane z = 1 minus its observed position. If jacobian is not null,
// fills in the derivative by (w, v) at (w, v) = 0 for the pose (exp(w) R, exp(w) t + v). Returns
// false for points behind the camera.
bool PlaneResidual(const geometry::Rigid3& camera_from_map,
                   const PoseMatch& match,
                   Eigen::Vector2d& residual,
                   Matrix26d* jacobian);

// The same for a point in the camera frame.
inline bool PlaneResidual(const Eigen::Vector3d& in_camera,
                          const Eigen::Vector2d& plane,
                          Eigen::Vector2d& residual,
                          Matrix26d* jacobian) {
  if (in_camera.z() <= 1e-9) {
    return false;
  }
  const double inverse = 1.0 / in_camera.z();
  const double x = in_camera.x() * inverse;
  const double y = in_camera.y() * inverse;
  residual = Eigen::Vector2d(x, y) - plane;
  if (jacobian != nullptr) {
    // The derivative d(x, y)/dp times [-[p]x | I].
    *jacobian << -x * y, 1.0 + x * x, -y, inverse, 0.0, -x * inverse,  //
        -(1.0 + y * y), x * y, x, 0.0, inverse, -y * inverse;
  }
  return true;
}

geometry::Rigid3 Moved(const geometry::Rigid3& camera_from_map, const Vector6d& step);

struct RefinementOptions {
  double focal = 1.0;  // Focal length in pixels; converts distances on the plane z = 1 to pixels.
  double inlier_threshold_px = 2.0;  // Threshold of a match whose sigma_px is 1.
};

struct RefinedPose {
  geometry::Rigid3 camera_from_map;
  std::vector<uint32_t> inliers;  // Indices of the inlier matches, ascending.
  // Robust standard deviation along one axis of a match whose sigma_px is 1.
  double noise_px = 0.0;
  Matrix6d covariance = Matrix6d::Zero();  // Covariance of (w, v).
};

// Minimises the Cauchy loss of the pixel residuals over their sigmas by iteratively reweighted
// Gauss-Newton with damping. In each round the loss narrows to the measured noise and the inliers
// are selected again. Reuses its memory from image to image.
class PoseRefiner {
 public:
  // start may refer to refined.camera_from_map. With fewer than 3 inliers, covariance and noise are
  // zero.
  void Refine(std::span<const PoseMatch> matches,
              const RefinementOptions& options,
              const geometry::Rigid3& start,
              RefinedPose& refined);

 private:
  std::vector<double> squares_;
};

}  // namespace lararium::vision
