#include "shared/vision/rolling_shutter.h"

namespace lararium::vision {

geometry::Rigid3 PoseAfter(const geometry::Rigid3& camera_from_map,
                           const Eigen::Matrix<double, 6, 1>& motion,
                           double time) {
  return geometry::Rigid3{geometry::RotationFromVector(time * motion.head<3>()),
                          time * motion.tail<3>()} *
         camera_from_map;
}

}  // namespace lararium::vision
