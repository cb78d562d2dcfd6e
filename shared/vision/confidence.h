#pragma once

// Confidence of a pose: the probability that its registration error is below a pixel. The same
// measure serves poses found in one image and poses tracked from frame to frame.

#include <array>

#include "shared/geometry/camera_model.h"
#include "shared/vision/camera_estimate.h"

namespace lararium::vision {

// The results of pose refinement from which the confidence is computed.
struct PoseEvidence {
  // Covariance of (w, v) in the pose (exp(w) R, exp(w) t + v), radians and map units, and of the
  // camera's parameters.
  JointMatrix<kMostJoint> covariance = JointMatrix<kMostJoint>::Zero();
  // Representative depths of the visible points, map units: nearer, middle, farther.
  std::array<double, 3> depths = {1.0, 1.0, 1.0};
  int inliers = 0;
  // The motion while the image was read, and the covariance of how its turning changes in a frame
  // time, which no pose with one motion shows; radians.
  RollingShutter shutter = {};
  Eigen::Matrix3d turning_change = Eigen::Matrix3d::Zero();
};

// The registration error that the covariance predicts, as a mean square over the image and the
// depths. The squared error is distributed as the sum of the squares of independent normal
// variables.
struct RegistrationVariance {
  double sum = 0.0;             // The sum of their variances, square pixels: the mean square.
  double sum_of_squares = 0.0;  // The sum of their squared variances.
};
RegistrationVariance ComputeRegistrationVariance(const geometry::CameraModel& camera,
                                                 const PoseEvidence& evidence);

// The probability that the registration error, root mean square over the image, is below limit_px.
// 0 with fewer than 4 inliers.
double PoseConfidence(const geometry::CameraModel& camera,
                      const PoseEvidence& evidence,
                      double limit_px = 1.0);

// I_x(a, b), the cumulative distribution function of the beta distribution, for a, b > 0 and x in
// [0, 1]. Accurate to 1e-12.
double RegularisedBeta(double a, double b, double x);

}  // namespace lararium::vision
