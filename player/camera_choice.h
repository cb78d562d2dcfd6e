#pragma once

// Which camera calibration the player goes by: the option, else the device file,
// else the bundle.

#include <string>

#include "player/options.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"

namespace lararium::player {

struct CameraChoice {
  geometry::CameraModel camera;  // for images of the source's size
  std::string origin;            // where it comes from, for the log
};

// trained: the camera of the scene database. width, height: of the images that
// will come. A calibration for another size is scaled when the aspect agrees;
// otherwise it is an error.
Result<CameraChoice> ChooseCamera(const PlayOptions& options,
                                  const geometry::CameraModel& trained,
                                  int width,
                                  int height);

}  // namespace lararium::player
