#pragma once

// The pose that explains where patches were found. Unlike features, a patch knows
// its place along its gradients only, hence a matrix of information for each.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "shared/geometry/transform.h"
#include "shared/vision/pose_refinement.h"

namespace lararium::vision {

struct PatchMatch {
  Eigen::Vector3d point;  // map
  Eigen::Vector2d plane;  // where it was found, on the camera's plane z = 1
  // W with W^T W the inverse covariance of plane, up to one factor for all.
  Eigen::Matrix2d whitening = Eigen::Matrix2d::Identity();
};

struct PatchPose {
  geometry::Rigid3 camera_from_map;
  std::vector<double> squares;  // of each match: squared whitened residual over scale^2
  int inliers = 0;              // squares below kInlierSquare
  double scale = 0.0;           // robust standard deviation of the whitened residuals, one axis
  Matrix6d covariance = Matrix6d::Zero();  // of (w, v); without the matches' common errors
  std::vector<Eigen::Vector3d> in_camera;  // the matches' points, of the last iteration
};

// 99 % of a two-dimensional normal distribution.
inline constexpr double kInlierSquare = 9.21;

// Iteratively reweighted Gauss-Newton with Tukey's loss, which gives outliers no
// weight, of a scale from the median. least_scale: of the whitened residuals, below
// which all are alike. Keeps its memory. false: fewer than 4 matches, or no minimum.
bool EstimatePatchPose(std::span<const PatchMatch> matches,
                       const geometry::Rigid3& start,
                       double least_scale,
                       PatchPose& pose);

}  // namespace lararium::vision
