#pragma once

// Rotations as angles that a person types.

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lararium::editor {

// Heading h about Y, tilt t about X, roll r about Z, radians, so that the rotation is Ry(h) Rx(t)
// Rz(r). Tilt is in [-pi/2, pi/2]; at both ends roll is 0.
Eigen::Vector3d HeadingTiltRoll(const Eigen::Quaterniond& rotation);
Eigen::Quaterniond FromHeadingTiltRoll(const Eigen::Vector3d& angles);

}  // namespace lararium::editor
