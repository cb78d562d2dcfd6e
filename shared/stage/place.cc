#include "shared/stage/place.h"

#include <algorithm>
#include <vector>

namespace lararium::stage {

geometry::Rigid3 CameraFromStage(const Place& place, const geometry::Rigid3& camera_from_map) {
  geometry::Rigid3 camera_from_stage = geometry::CameraFromB(camera_from_map, place.map_from_stage);
  // Moving the camera moves the scene the opposite way in the camera frame.
  camera_from_stage.translation -= place.camera_nudge;
  return camera_from_stage;
}

geometry::Rigid3 CameraFromMap(const Place& place, const geometry::Rigid3& camera_from_stage) {
  geometry::Rigid3 without_nudge = camera_from_stage;
  without_nudge.translation += place.camera_nudge;
  return geometry::CameraFromB(without_nudge, place.map_from_stage.Inverse());
}

namespace {

std::vector<const Occluder*> InTheWay(const Place& place) {
  std::vector<const Occluder*> occluders;
  for (const Occluder& occluder : place.occluders) {
    if (occluder.blocks_walking) {
      occluders.push_back(&occluder);
    }
  }
  return occluders;
}

}  // namespace

bool BlockWalkingAlike(const Place& a, const Place& b) {
  const std::vector<const Occluder*> of_a = InTheWay(a);
  const std::vector<const Occluder*> of_b = InTheWay(b);
  return std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(),
                    [](const Occluder* one, const Occluder* other) {
                      return one->stage_from_mesh == other->stage_from_mesh &&
                             one->mesh.positions == other->mesh.positions &&
                             one->mesh.indices == other->mesh.indices;
                    });
}

}  // namespace lararium::stage
