#pragma once

// What of the camera's view a picture of other proportions shows.

#include "shared/geometry/camera_model.h"

namespace lararium::show {

// The display's pinhole of a camera (CameraModel::DisplayPinhole), cut to the proportions of
// width x height about its middle: nothing is stretched, and no border stays empty.
geometry::CameraModel PictureCamera(const geometry::CameraModel& camera, int width, int height);

}  // namespace lararium::show
