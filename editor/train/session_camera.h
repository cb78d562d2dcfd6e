#pragma once

// Finds out whether the camera that a map was trained with took the images of a new session, too.

#include <cstdint>
#include <optional>

#include "shared/capture/frame_source.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/geometry/camera_model.h"
#include "shared/vision/scene_database.h"

namespace lararium::train {

// Locates some of the source's images in the map as those of an unknown camera, and compares the
// focal lengths that they show with that of the map's camera. Returns the map's camera for images
// of the source's size if it took them; nullopt if another one did, or if the images do not tell.
// Reads the source from its start to its end.
Result<std::optional<geometry::CameraModel>> RecogniseCamera(const vision::SceneDatabase& map,
                                                             capture::FrameSource& source,
                                                             uint64_t seed,
                                                             Progress& progress,
                                                             Log& log);

}  // namespace lararium::train
