#pragma once

// A virtual trackball: Shoemake, "ARCBALL: A User Interface for Specifying
// Three-Dimensional Orientation Using a Mouse", Graphics Interface 1992.

#include <Eigen/Geometry>

namespace lararium::panels {

class Trackball {
 public:
  // center, radius_px: the ball in window pixels (x right, y down).
  Trackball(const Eigen::Vector2d& center, double radius_px)
      : center_(center), radius_px_(radius_px) {}

  // The point of the unit ball at a pixel, in view axes (x right, y up, z to the viewer). Pixels
  // outside the ball map to its rim.
  Eigen::Vector3d PointOnBall(const Eigen::Vector2d& pixel) const;

  // The rotation, in view axes, for a drag between two pixels: twice the arc between their points,
  // so that opposite rims are a full turn apart and a drag back to its beginning gives no rotation.
  Eigen::Quaterniond Turn(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

 private:
  Eigen::Vector2d center_;
  double radius_px_;
};

}  // namespace lararium::panels
