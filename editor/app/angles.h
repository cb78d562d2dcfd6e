#pragma once

// Rotations as people type them.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lararium::app {

// Heading h about Y, tilt t about X, roll r about Z, radians, so that the
// rotation is Ry(h) Rx(t) Rz(r). Tilt lies within a quarter turn; at its ends
// roll is 0.
Eigen::Vector3d HeadingTiltRoll(const Eigen::Quaterniond& rotation);
Eigen::Quaterniond FromHeadingTiltRoll(const Eigen::Vector3d& angles);

}  // namespace lararium::app
