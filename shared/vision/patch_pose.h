#pragma once

// Estimates a pose from patch positions. Unlike a feature, a patch is localised only along its
// image gradients, so each match carries its own information matrix.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "shared/geometry/transform.h"
#include "shared/vision/camera_estimate.h"
#include "shared/vision/pose_refinement.h"

namespace lararium::vision {

struct PatchMatch {
  Eigen::Vector3d point;  // Map frame.
  Eigen::Vector2d pixel;  // Measured position, raw pixel.
  // W such that W^T W is the inverse covariance of `pixel`, up to a factor common to all matches.
  Eigen::Matrix2d whitening = Eigen::Matrix2d::Identity();
};

// What is known of the camera before the patches of an image are found.
struct CameraPrior {
  CameraEstimate camera;
  FrameMotion motion = nullptr;  // Matters only for a rolling shutter.
  // Factor on the covariance of the pose by the patches, for errors that they share; see
  // PatchPose::covariance.
  double shared_errors = 1.0;
};

struct PatchPose {
  PosedCamera posed;            // The camera keeps the covariance of the prior.
  std::vector<double> squares;  // [matches]: Squared whitened residual over scale^2.
  int inliers = 0;              // Number of squares below kInlierSquare.
  double scale = 0.0;  // Robust standard deviation of the whitened residuals along one axis.
  // Covariance of (w, v) and the camera's parameters, shared errors included.
  JointMatrix<kMostJoint> covariance = JointMatrix<kMostJoint>::Zero();
  std::vector<Eigen::Vector3d> in_camera;  // [matches]: Points in the camera frame.
};

// 99 % quantile of the squared norm of a two-dimensional normal distribution.
inline constexpr double kInlierSquare = 9.21;

// Iteratively reweighted Gauss-Newton with Tukey's loss, which gives outliers no weight. The scale
// comes from the median of the whitened residuals and is at least least_scale. Estimates also the
// parameters of the camera that are not known. start may refer to pose.posed. Reuses the memory of
// `pose`. Returns false with fewer than 4 matches or without a minimum.
bool EstimatePatchPose(std::span<const PatchMatch> matches,
                       const CameraPrior& prior,
                       const PosedCamera& start,
                       double least_scale,
                       PatchPose& pose);

}  // namespace lararium::vision
