#include "editor/app/picked_frames.h"

#include <algorithm>
#include <set>
#include <utility>

namespace lararium::app {

namespace {

// The frames of a session that were picked in, in their order.
std::set<int64_t> PickedFrames(const PlaceDocument& place, uint32_t session) {
  std::set<int64_t> frames;
  const auto add = [&](const stage::Anchor& anchor) {
    for (const stage::Pick& pick : anchor.picks) {
      if (pick.session == session) {
        frames.insert(pick.frame_index);
      }
    }
  };
  const stage::StagePicks& picks = place.picks;
  for (const stage::Anchor* anchor :
       {&picks.origin, &picks.forward, &picks.floor, &picks.length_from, &picks.length_to}) {
    add(*anchor);
  }
  for (const OccluderDocument& occluder : place.occluders) {
    std::for_each(occluder.corners.begin(), occluder.corners.end(), add);
    for (const ModelPairDocument& pair : occluder.model_pairs) {
      add(pair.anchor);
    }
  }
  std::for_each(place.check_picks.begin(), place.check_picks.end(), add);
  return frames;
}

bool IsKeyframe(const vision::SceneDatabase& database, uint32_t session, int64_t frame) {
  return std::any_of(database.keyframes.begin(), database.keyframes.end(),
                     [&](const vision::Keyframe& keyframe) {
                       return keyframe.session == session && keyframe.frame_index == frame;
                     });
}

}  // namespace

Status KeepPickedFrames(const PlaceDocument& place,
                        uint32_t session,
                        const train::TrainReport& report,
                        capture::FrameSource& source,
                        vision::SceneDatabase& database) {
  for (const int64_t frame : PickedFrames(place, session)) {
    const auto located = std::find_if(report.located.begin(), report.located.end(),
                                      [&](const auto& l) { return l.frame_index == frame; });
    if (located == report.located.end() || IsKeyframe(database, session, frame)) {
      continue;
    }
    LARARIUM_RETURN_IF_ERROR(source.Seek(frame));
    LARARIUM_ASSIGN_OR_RETURN(const std::optional<geometry::Frame> image, source.Next());
    if (!image || image->grey.cols != database.camera.width ||
        image->grey.rows != database.camera.height) {
      continue;
    }
    vision::Keyframe keyframe;
    keyframe.frame_index = frame;
    keyframe.name = located->name;
    keyframe.session = session;
    keyframe.camera_from_map = located->camera_from_map;
    keyframe.grey = image->grey.clone();
    database.keyframes.push_back(std::move(keyframe));
  }
  return Status();
}

}  // namespace lararium::app
