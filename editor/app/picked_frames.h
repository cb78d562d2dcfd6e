#pragma once

// Picks outlive the map that they were made in: another training may choose other
// keyframes, and the frames that were picked in must stay.

#include <cstdint>
#include <memory>
#include <optional>

#include "editor/app/preview.h"
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

// The frame in a picture of the camera view as an image to pick in.
struct FrameToPick {
  // The map's where it has one of this frame; otherwise as WithFrame() would make it one, with
  // the pose that the frame was located with. None: the frame cannot be picked in.
  std::optional<vision::Keyframe> keyframe;
  const char* problem = "";  // why; English, see Tr()
};
// shows_training: the picture is of the place's training recording. Frames of others would be
// another frame to whoever trains again.
FrameToPick FindFrameToPick(const PreviewPicture& picture,
                            const vision::SceneDatabase& database,
                            bool shows_training);

// The map with a frame as one more keyframe without observations, as KeepPickedFrames() makes them
// after training, so that picks in it count; the very same map where it has the frame already.
std::shared_ptr<const vision::SceneDatabase> WithFrame(
    std::shared_ptr<const vision::SceneDatabase> map, const vision::Keyframe& keyframe);

}  // namespace lararium::app
