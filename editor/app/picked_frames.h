#pragma once

// Picks outlive the map that they were made in: another training may choose other
// keyframes, and the frames that were picked in must stay.

#include <cstdint>

#include "editor/app/project.h"
#include "editor/train/trainer.h"
#include "shared/capture/frame_source.h"
#include "shared/core/status.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

// Adds to the database, as keyframes without observations, the frames that were picked in (for the
// stage, an occluder's corners, a model's points or check points) and that training located, but
// did not choose. They go after the others; images come from source, whose frames the report is
// about and whose camera is the database's. Frames that were not located are left out.
Status KeepPickedFrames(const PlaceDocument& place,
                        uint32_t session,
                        const train::TrainReport& report,
                        capture::FrameSource& source,
                        vision::SceneDatabase& database);

}  // namespace lararium::app
