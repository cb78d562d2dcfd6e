#include "editor/jobs/object_pose.h"

#include <cmath>
#include <numbers>

#include "shared/geometry/glm_convert.h"

namespace lararium::editor {

stage::Pose InitialPose(const ObjectDocument& object) {
  const geometry::Rigid3 pose = StageFromObject(object);
  return {geometry::ToGlm(pose.translation), geometry::ToGlm(pose.rotation)};
}

void PlaceObject(const Eigen::Quaterniond& stage_from_object,
                 const Eigen::Vector3d& position,
                 ObjectDocument& object) {
  constexpr double kMillimetres = 1000.0;
  constexpr double kTenths = 10.0;
  // Adding 0 avoids -0.
  object.position = (kMillimetres * position).array().round() / kMillimetres + 0.0;
  const Eigen::Vector3d right = stage_from_object * Eigen::Vector3d::UnitX();
  const double heading = std::atan2(-right.z(), right.x()) * 180.0 / std::numbers::pi;
  // Keeps the number in the document where the heading did not change: 270 and -90 are equal.
  if (std::abs(std::remainder(heading - object.heading, 360.0)) > 0.5 / kTenths) {
    object.heading = std::round(kTenths * heading) / kTenths;
  }
}

}  // namespace lararium::editor
