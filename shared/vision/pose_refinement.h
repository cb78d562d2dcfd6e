#pragma once

// The pose that explains matches between image and map best.

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"

namespace lararium::vision {

// A map point seen at an undistorted place.
struct PoseMatch {
  Eigen::Vector3d point;  // map
  Eigen::Vector2d plane;  // on the camera's plane z = 1
  double sigma_px = 1.0;  // relative uncertainty of its place, 1 for the finest features
};

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix26d = Eigen::Matrix<double, 2, 6>;

// Where the point falls on the plane z = 1, less where it was seen. Fills the
// derivative for pose -> (exp(w) R, exp(w) t + v), (w, v) = 0, when asked. Points
// behind the camera give false.
bool PlaneResidual(const geometry::Rigid3& camera_from_map,
                   const PoseMatch& match,
                   Eigen::Vector2d& residual,
                   Matrix26d* jacobian);

// The same of a point in the camera's frame.
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
    // d(x, y)/dp times [-[p]x | I].
    *jacobian << -x * y, 1.0 + x * x, -y, inverse, 0.0, -x * inverse,  //
        -(1.0 + y * y), x * y, x, 0.0, inverse, -y * inverse;
  }
  return true;
}

geometry::Rigid3 Moved(const geometry::Rigid3& camera_from_map, const Vector6d& step);

struct RefinementOptions {
  double focal = 1.0;                // turns the plane into pixels
  double inlier_threshold_px = 2.0;  // times a match's sigma
};

struct RefinedPose {
  geometry::Rigid3 camera_from_map;
  std::vector<uint32_t> inliers;           // of the matches, ascending
  double noise_px = 0.0;                   // robust standard deviation, along one axis, at sigma 1
  Matrix6d covariance = Matrix6d::Zero();  // of (w, v)
};

// Iteratively reweighted Gauss-Newton with damping: minimises the Cauchy loss of
// pixel residuals over their sigmas; the loss narrows to the noise found and the
// inliers are chosen anew. Keeps its memory from image to image.
class PoseRefiner {
 public:
  // start may be refined.camera_from_map. Fewer than 3 inliers: covariance and
  // noise are zero.
  void Refine(std::span<const PoseMatch> matches,
              const RefinementOptions& options,
              const geometry::Rigid3& start,
              RefinedPose& refined);

 private:
  std::vector<double> squares_;
};

}  // namespace lararium::vision
