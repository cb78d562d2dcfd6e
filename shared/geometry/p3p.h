#pragma once

// The pose of a calibrated camera from three points.

#include <Eigen/Core>
#include <array>
#include <span>

#include "shared/geometry/transform.h"

namespace lararium::geometry {

struct P3pSolutions {
  std::array<Rigid3, 4> camera_from_world;
  int count = 0;

  // Not available on temporaries, because the span would dangle.
  std::span<const Rigid3> poses() const& {
    return {camera_from_world.data(), static_cast<size_t>(count)};
  }
  std::span<const Rigid3> poses() const&& = delete;
};

// Returns all poses (up to four) from which points_in_world are seen along the rays: unit
// directions in camera coordinates, with the points in front. Returns none for collinear points,
// coinciding rays or non-finite numbers.
//
// The depths along the rays satisfy three quadrics. The pencil of two of their combinations
// contains a degenerate conic, a pair of planes, whose intersection with the rest gives quadratics:
// Persson & Nordberg, "Lambda Twist: An Accurate Fast Robust Perspective Three Point (P3P) Solver",
// ECCV 2018, sections 3.1 to 3.4. Here the planes come from the conic's coefficients instead of its
// eigenvectors.
P3pSolutions SolveP3p(const std::array<Eigen::Vector3d, 3>& rays,
                      const std::array<Eigen::Vector3d, 3>& points_in_world);

}  // namespace lararium::geometry
