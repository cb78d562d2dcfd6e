#include "editor/panels/viewport/trackball.h"

#include <cmath>

namespace lararium::panels {

Eigen::Vector3d Trackball::PointOnBall(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d offset = (pixel - center_) / radius_px_;
  const Eigen::Vector2d plane(offset.x(), -offset.y());
  const double squared = plane.squaredNorm();
  if (squared >= 1.0) {
    const Eigen::Vector2d rim = plane / std::sqrt(squared);
    return {rim.x(), rim.y(), 0.0};
  }
  return {plane.x(), plane.y(), std::sqrt(1.0 - squared)};
}

Eigen::Quaterniond Trackball::Turn(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const Eigen::Vector3d a = PointOnBall(from);
  const Eigen::Vector3d b = PointOnBall(to);
  const Eigen::Vector3d axis = a.cross(b);
  return Eigen::Quaterniond(a.dot(b), axis.x(), axis.y(), axis.z()).normalized();
}

}  // namespace lararium::panels
