#pragma once

// Points from views: Hartley & Zisserman, "Multiple View Geometry in Computer
// Vision", 2nd edition, chapter 12.

#include <Eigen/Core>
#include <optional>
#include <span>

#include "shared/geometry/transform.h"

namespace lararium::geometry {

// The point, in world coordinates, that is seen at plane_points (x, y on the
// plane z = 1) by the cameras of the same index: the homogeneous linear solution
// (12.2), then Gauss-Newton on the distances on that plane, where all views
// weigh alike. nullopt with fewer than two views, when the rays do not fix a
// point (parallel, or one centre), or when it lies behind a camera.
std::optional<Eigen::Vector3d> TriangulatePoint(std::span<const Rigid3> camera_from_world,
                                                std::span<const Eigen::Vector2d> plane_points);

// The angle, 0..pi radians, at which the rays from two centres meet in point.
double TriangulationAngle(const Eigen::Vector3d& center_a,
                          const Eigen::Vector3d& center_b,
                          const Eigen::Vector3d& point);

}  // namespace lararium::geometry
