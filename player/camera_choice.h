#pragma once

// Which camera calibration the player goes by: the option, else the device file,
// else the bundle.

#include <span>
#include <string>

#include "player/options.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"

namespace lararium::player {

// What a place of the bundle was trained with.
struct TrainedCamera {
  std::string place;
  geometry::CameraModel camera;
};

struct CameraChoice {
  geometry::CameraModel camera;  // for images of the source's size
  std::string origin;            // where it comes from, for the log
};

// trained: of each place, at least one; the first that fits serves for all of them.
// width, height: of the images that will come. A calibration for another size is
// scaled when the aspect agrees; otherwise it does not fit, which is an error.
Result<CameraChoice> ChooseCamera(const PlayOptions& options,
                                  std::span<const TrainedCamera> trained,
                                  int width,
                                  int height);

}  // namespace lararium::player
