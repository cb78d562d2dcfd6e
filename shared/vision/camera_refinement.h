#pragma once

// Refines a pose together with the intrinsics of the camera.

#include <span>
#include <vector>

#include "shared/vision/camera_estimate.h"
#include "shared/vision/pose_refinement.h"

namespace lararium::vision {

struct RefinedCamera {
  PosedCamera posed;              // The camera keeps the covariance of the start.
  std::vector<uint32_t> inliers;  // Indices of the inlier matches, ascending.
  // Robust standard deviation along one axis of a match whose sigma_px is 1.
  double noise_px = 0.0;
  // Inverse covariance of (w, v, parameters) by the matches alone, for a noise of one pixel.
  JointMatrix<kMostJoint> information = JointMatrix<kMostJoint>::Zero();
};

// As PoseRefiner, for a camera that is estimated with the pose.
class CameraRefiner {
 public:
  // prior: what is known of the camera, with its covariance. start may refer to refined.posed. Uses
  // PoseMatch::pixel. With fewer than 7 inliers, information and noise are zero.
  void Refine(std::span<const PoseMatch> matches,
              double inlier_threshold_px,
              const PosedCamera& start,
              const CameraEstimate& prior,
              RefinedCamera& refined);

 private:
  std::vector<double> squares_;
};

}  // namespace lararium::vision
