#include "shared/stage/place.h"

namespace lararium::stage {

geometry::Rigid3 CameraFromStage(const Place& place, const geometry::Rigid3& camera_from_map) {
  geometry::Rigid3 camera_from_stage = geometry::CameraFromB(camera_from_map, place.map_from_stage);
  // What the camera moves by, everything seen moves against.
  camera_from_stage.translation -= place.camera_nudge;
  return camera_from_stage;
}

}  // namespace lararium::stage
