#pragma once

// The pose, focal length and radial distortion of a camera from five points.

#include <Eigen/Core>
#include <array>
#include <span>

#include "shared/geometry/transform.h"

namespace lararium::geometry {

struct RadialPose {
  Rigid3 camera_from_world;
  double focal = 0.0;  // pixels
  // Fitzgibbon's division model: a pixel at distance r from the principal point has the undistorted
  // distance r / (1 + division r^2). Square pixels^-1.
  double division = 0.0;
};

struct RadialPoseSolutions {
  std::array<RadialPose, 4> solutions;
  int count = 0;

  // Not available on temporaries, because the span would dangle.
  std::span<const RadialPose> all() const& {
    return {solutions.data(), static_cast<size_t>(count)};
  }
  std::span<const RadialPose> all() const&& = delete;
};

// Returns all poses (up to four) from which points_in_world are seen in front of the camera at the
// pixels, which are relative to the principal point. half_size: half the longer side of the image,
// pixels.
//
// The direction from the principal point to a pixel depends neither on the focal length nor on the
// radial distortion. Five directions determine the first two rows of the pose, by two quadrics in
// the null space of five linear equations; the five distances then determine the rest linearly:
// Kukelova, Bujnak & Pajdla, "Real-time solution to the absolute pose problem with unknown radial
// distortion and focal length", ICCV 2013. Where the distances leave the distortion undetermined,
// it tends to zero.
RadialPoseSolutions SolveRadialPose(const std::array<Eigen::Vector2d, 5>& pixels,
                                    const std::array<Eigen::Vector3d, 5>& points_in_world,
                                    double half_size);

}  // namespace lararium::geometry
