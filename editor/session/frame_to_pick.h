#pragma once

// Picking of corners in the frame that the camera view shows.

#include <optional>

#include "editor/session/preview.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

// A frame in the camera view as an image for picks.
struct FrameToPick {
  // The map's keyframe, if it has one of this frame; otherwise the one that WithFrame() would add,
  // with the pose from tracking. Not set: picks in this frame are not possible.
  std::optional<vision::Keyframe> keyframe;
  const char* problem = "";  // The reason, in English; see Tr().
};
// shows_training: the picture is from the place's training recording. Frames of other recordings
// cannot be used, because training would find another frame under their number.
FrameToPick FindFrameToPick(const PreviewPicture& picture,
                            const vision::SceneDatabase& database,
                            bool shows_training);

}  // namespace lararium::editor
