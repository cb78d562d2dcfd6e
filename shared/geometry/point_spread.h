#pragma once

#include <Eigen/Core>
#include <span>

namespace lararium::geometry {

// Where points lie, and how far they spread about their mean.
struct PointSpread {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  // Principal axes: unit vectors, as columns. The first is the normal of the plane that fits the
  // points best by least squares, the last the direction of the line that does.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  // Standard deviations along the axes in units of the points, smallest first.
  Eigen::Vector3d deviations = Eigen::Vector3d::Zero();
};

// Without points, everything is as initialised above.
PointSpread SpreadOf(std::span<const Eigen::Vector3d> points);

}  // namespace lararium::geometry
