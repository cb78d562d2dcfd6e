#include "editor/jobs/picked_frames.h"

#include <algorithm>
#include <set>
#include <utility>

namespace lararium::editor {

namespace {

// The frames of a session that have picks, in their order.
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

}  // namespace

const vision::Keyframe* FindKeyframe(const vision::SceneDatabase& database,
                                     uint32_t session,
                                     int64_t frame) {
  const auto found = std::find_if(
      database.keyframes.begin(), database.keyframes.end(), [&](const vision::Keyframe& keyframe) {
        return keyframe.session == session && keyframe.frame_index == frame;
      });
  return found == database.keyframes.end() ? nullptr : &*found;
}

Status KeepPickedFrames(const PlaceDocument& place,
                        uint32_t session,
                        const train::TrainReport& report,
                        capture::FrameSource& source,
                        vision::SceneDatabase& database) {
  for (const int64_t frame : PickedFrames(place, session)) {
    const auto located = std::find_if(report.located.begin(), report.located.end(),
                                      [&](const auto& l) { return l.frame_index == frame; });
    if (located == report.located.end() || FindKeyframe(database, session, frame) != nullptr) {
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

std::shared_ptr<const vision::SceneDatabase> WithFrame(
    std::shared_ptr<const vision::SceneDatabase> map, const vision::Keyframe& keyframe) {
  if (FindKeyframe(*map, keyframe.session, keyframe.frame_index) != nullptr) {
    return map;
  }
  // Copies the map, because others still use it.
  auto with_frame = std::make_shared<vision::SceneDatabase>(*map);
  with_frame->keyframes.push_back(keyframe);
  return with_frame;
}

}  // namespace lararium::editor
