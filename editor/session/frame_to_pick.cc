#include "editor/session/frame_to_pick.h"

#include <utility>

#include "editor/jobs/picked_frames.h"
#include "editor/text/text.h"

namespace lararium::editor {

FrameToPick FindFrameToPick(const PreviewPicture& picture,
                            const vision::SceneDatabase& database,
                            bool shows_training) {
  constexpr uint32_t kTraining = 0;  // The session of the training recording.
  if (!shows_training) {
    return {std::nullopt, TrLater("Corners are picked in frames of the training recording")};
  }
  if (const vision::Keyframe* known = FindKeyframe(database, kTraining, picture.frame)) {
    return {*known};
  }
  if (!picture.camera_from_map) {
    return {std::nullopt, TrLater("The map does not locate this frame: pick in another one")};
  }
  const geometry::CameraModel& camera = database.camera;
  if (picture.camera != camera || picture.grey.cols != camera.width ||
      picture.grey.rows != camera.height) {
    return {std::nullopt, TrLater("The recording is not as it was when the place was trained")};
  }
  vision::Keyframe keyframe;
  keyframe.frame_index = picture.frame;
  keyframe.name = picture.name;
  keyframe.session = kTraining;
  keyframe.camera_from_map = *picture.camera_from_map;
  keyframe.grey = picture.grey;
  return {std::move(keyframe)};
}

}  // namespace lararium::editor
