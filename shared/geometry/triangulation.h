#pragma once

// Triangulation of points from several views: Hartley & Zisserman, "Multiple View Geometry in
// Computer Vision", 2nd edition, chapter 12.

#include <Eigen/Core>
#include <optional>
#include <span>

#include "shared/geometry/transform.h"

namespace lararium::geometry {

// Returns the point in world coordinates that the cameras see at plane_points (x, y on the plane z
// = 1) of the same index. The homogeneous linear solution (12.2) is refined by Gauss-Newton on the
// distances on that plane, with equal weights for all views. Returns nullopt for fewer than two
// views, if the rays do not determine a point (parallel, or one centre), or if the point is behind
// a camera.
std::optional<Eigen::Vector3d> TriangulatePoint(std::span<const Rigid3> camera_from_world,
                                                std::span<const Eigen::Vector2d> plane_points);

// Returns the angle, 0..pi radians, at which the rays from two centres meet in `point`.
double TriangulationAngle(const Eigen::Vector3d& center_a,
                          const Eigen::Vector3d& center_b,
                          const Eigen::Vector3d& point);
// Returns the widest triangulation angle at `point`, radians, of any two of the centres; 0 for
// fewer than two.
double WidestAngle(std::span<const Eigen::Vector3d> centers, const Eigen::Vector3d& point);

}  // namespace lararium::geometry
