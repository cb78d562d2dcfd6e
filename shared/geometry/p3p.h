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

  // Of a variable, not of a temporary that would be gone.
  std::span<const Rigid3> poses() const& {
    return {camera_from_world.data(), static_cast<size_t>(count)};
  }
  std::span<const Rigid3> poses() const&& = delete;
};

// All poses (up to four) from which points_in_world are seen along rays: unit
// directions in camera coordinates, the points in front. None for points on a
// line, coinciding rays or numbers that are not finite.
//
// The depths along the rays satisfy three quadrics. The pencil of two of their
// combinations holds a degenerate conic, a pair of planes, which meets the rest
// in quadratics: Persson & Nordberg, "Lambda Twist: An Accurate Fast Robust
// Perspective Three Point (P3P) Solver", ECCV 2018, sections 3.1 to 3.4. Here the
// planes are read off the conic's coefficients instead of its eigenvectors.
P3pSolutions SolveP3p(const std::array<Eigen::Vector3d, 3>& rays,
                      const std::array<Eigen::Vector3d, 3>& points_in_world);

}  // namespace lararium::geometry
