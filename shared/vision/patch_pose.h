#pragma once

// Estimates a pose from patch positions. Unlike a feature, a patch is localised only along its
// image gradients, so each match carries its own information matrix.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "shared/geometry/transform.h"
#include "shared/vision/pose_refinement.h"

namespace lararium::vision {

struct PatchMatch {
  Eigen::Vector3d point;  // Map frame.
  Eigen::Vector2d plane;  // Measured position on the camera's plane z = 1.
  // W such that W^T W is the inverse covariance of `plane`, up to a factor common to all matches.
  Eigen::Matrix2d whitening = Eigen::Matrix2d::Identity();
};

struct PatchPose {
  geometry::Rigid3 camera_from_map;
  std::vector<double> squares;  // [matches]: Squared whitened residual over scale^2.
  int inliers = 0;              // Number of squares below kInlierSquare.
  double scale = 0.0;  // Robust standard deviation of the whitened residuals along one axis.
  Matrix6d covariance = Matrix6d::Zero();  // Covariance of (w, v), without shared errors.
  std::vector<Eigen::Vector3d> in_camera;  // [matches]: Points in the camera frame.
};

// 99 % quantile of the squared norm of a two-dimensional normal distribution.
inline constexpr double kInlierSquare = 9.21;

// Iteratively reweighted Gauss-Newton with Tukey's loss, which gives outliers no weight. The scale
// comes from the median of the whitened residuals and is at least least_scale. Reuses the memory of
// `pose`. Returns false with fewer than 4 matches or without a minimum.
bool EstimatePatchPose(std::span<const PatchMatch> matches,
                       const geometry::Rigid3& start,
                       double least_scale,
                       PatchPose& pose);

}  // namespace lararium::vision
