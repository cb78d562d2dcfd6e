#pragma once

// Chooses the camera calibration of the player: from the option --intrinsics, else from the device
// file. Otherwise the tracker estimates it, and begins with the camera of the bundle.

#include <span>
#include <string>

#include "player/app/options.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"

namespace lararium::player {

// The camera that a place of the bundle was trained with.
struct TrainedCamera {
  std::string place;
  geometry::CameraModel camera;
};

struct CameraChoice {
  geometry::CameraModel camera;  // scaled to the size of the source's images
  std::string origin;            // source of the calibration, for the log
  bool known = true;             // False if the camera is a guess.
};

// trained: the cameras of all places, at least one; the first that fits is the guess. width and
// height: size of the source's images. A given calibration for another size is scaled if the aspect
// ratio agrees; otherwise it does not fit, which is an error.
Result<CameraChoice> ChooseCamera(const CameraOptions& options,
                                  std::span<const TrainedCamera> trained,
                                  int width,
                                  int height);

}  // namespace lararium::player
