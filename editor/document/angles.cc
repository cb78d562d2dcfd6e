#include "editor/document/angles.h"

#include <algorithm>
#include <cmath>

namespace lararium::editor {

Eigen::Vector3d HeadingTiltRoll(const Eigen::Quaterniond& rotation) {
  const Eigen::Matrix3d r = rotation.toRotationMatrix();
  // R = Ry(h) Rx(t) Rz(r): its second row is (cos t sin r, cos t cos r, -sin t).
  const double tilt = std::asin(std::clamp(-r(1, 2), -1.0, 1.0));
  constexpr double kUpright = 1.0 - 1e-9;
  if (std::abs(r(1, 2)) > kUpright) {  // Tilt of +-90 degrees: roll is not defined, so it is 0.
    return {std::atan2(-r(2, 0), r(0, 0)), tilt, 0.0};
  }
  return {std::atan2(r(0, 2), r(2, 2)), tilt, std::atan2(r(1, 0), r(1, 1))};
}

Eigen::Quaterniond FromHeadingTiltRoll(const Eigen::Vector3d& angles) {
  return (Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()))
      .normalized();
}

}  // namespace lararium::editor
