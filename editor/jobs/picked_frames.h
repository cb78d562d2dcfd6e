#pragma once

// Picks refer to frames of a recording, and training again may choose other keyframes. These
// functions keep the frames with picks in the map.

#include <cstdint>
#include <memory>

#include "editor/document/project.h"
#include "editor/train/trainer.h"
#include "shared/capture/frame_source.h"
#include "shared/core/status.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

// Adds the frames with picks (of the stage, an occluder's corners, a model's points or check
// points) that training located but did not choose, as keyframes without observations, behind the
// others. Frames that were not located are left out. source: the recording that the report is
// about, with the camera of the database.
Status KeepPickedFrames(const PlaceDocument& place,
                        uint32_t session,
                        const train::TrainReport& report,
                        capture::FrameSource& source,
                        vision::SceneDatabase& database);

// The keyframe of a recording's frame; nullptr where the database has none.
const vision::Keyframe* FindKeyframe(const vision::SceneDatabase& database,
                                     uint32_t session,
                                     int64_t frame);

// Adds a frame as a keyframe without observations, like KeepPickedFrames(), so that picks in it
// count. Returns the same map where it already has the frame.
std::shared_ptr<const vision::SceneDatabase> WithFrame(
    std::shared_ptr<const vision::SceneDatabase> map, const vision::Keyframe& keyframe);

}  // namespace lararium::editor
