#pragma once

// How far a pose can be trusted: the chance that it registers what is visible to
// a pixel, for poses found in one image and for poses followed alike.

#include <array>
#include <cstdint>

#include "shared/geometry/camera_model.h"
#include "shared/vision/pose_refinement.h"

namespace lararium::vision {

// What the refinement of a pose leaves as evidence.
struct PoseEvidence {
  // Of (w, v) in the pose (exp(w) R, exp(w) t + v), map units.
  Matrix6d covariance = Matrix6d::Zero();
  // Distances along the view of what the image shows: nearer, middle, farther.
  std::array<double, 3> depths = {1.0, 1.0, 1.0};
  int inliers = 0;
};

// Mean square of the registration error in pixels that the covariance foretells,
// over the image and the depths, and how its distribution spreads: the error's
// square is a sum of independent squares of these variances.
struct RegistrationVariance {
  std::array<double, 6> parts = {};  // square pixels, in descending order
  double Sum() const;
};
RegistrationVariance ComputeRegistrationVariance(const geometry::CameraModel& camera,
                                                 const PoseEvidence& evidence);

// The probability that the pose puts what is visible within limit_px of its
// place, on average over the image (root mean square). 0 with fewer than 4 inliers.
double PoseConfidence(const geometry::CameraModel& camera,
                      const PoseEvidence& evidence,
                      double limit_px = 1.0);

// I_x(a, b), the distribution function of the beta distribution; a, b > 0, x in
// [0, 1]. To 1e-12.
double RegularisedBeta(double a, double b, double x);

}  // namespace lararium::vision
