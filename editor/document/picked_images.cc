#include "editor/document/picked_images.h"

#include <algorithm>
#include <limits>

namespace lararium::editor {

namespace {

std::optional<uint32_t> KeyframeOf(const stage::Pick& pick, const vision::SceneDatabase& map) {
  const auto found =
      std::find_if(map.keyframes.begin(), map.keyframes.end(),
                   [&](const vision::Keyframe& keyframe) { return LiesIn(pick, keyframe); });
  return found == map.keyframes.end()
             ? std::nullopt
             : std::optional(static_cast<uint32_t>(found - map.keyframes.begin()));
}

}  // namespace

std::vector<PickedImage> PickedImagesOf(const stage::Anchor& anchor,
                                        const vision::SceneDatabase& map) {
  std::vector<PickedImage> images;
  for (const stage::Pick& pick : anchor.picks) {
    images.push_back({pick, KeyframeOf(pick, map), std::nullopt});
  }
  std::stable_sort(images.begin(), images.end(), [](const PickedImage& a, const PickedImage& b) {
    constexpr uint32_t kLast = std::numeric_limits<uint32_t>::max();
    return a.keyframe.value_or(kLast) < b.keyframe.value_or(kLast);
  });
  const auto in_map = std::count_if(images.begin(), images.end(),
                                    [](const PickedImage& image) { return image.keyframe; });
  if (in_map < 2) {
    return images;
  }
  const Result<stage::AnchorReport> report = stage::SolveAnchor(anchor, map);
  for (PickedImage& image : images) {
    if (report.ok() && image.keyframe) {
      const auto seen =
          map.camera.Project(map.keyframes[*image.keyframe].camera_from_map * report->point_in_map);
      if (seen) {
        image.error_px = (*seen - image.pick.pixel).norm();
      }
    }
  }
  return images;
}

std::optional<uint32_t> NextPicked(std::span<const PickedImage> images,
                                   uint32_t keyframe,
                                   int direction) {
  std::optional<uint32_t> next;
  for (const PickedImage& image : images) {
    if (!image.keyframe ||
        (direction > 0 ? *image.keyframe <= keyframe : *image.keyframe >= keyframe)) {
      continue;
    }
    if (!next || (direction > 0 ? *image.keyframe < *next : *image.keyframe > *next)) {
      next = image.keyframe;
    }
  }
  return next;
}

std::string NameOfImage(const stage::Pick& pick) {
  return pick.frame.empty() ? std::to_string(pick.frame_index) : pick.frame;
}

Result<stage::Pick> FindPick(const stage::Anchor& anchor,
                             const std::string& option,
                             const std::string& frame,
                             uint32_t session) {
  std::string images;
  for (const stage::Pick& pick : anchor.picks) {
    const std::string name = NameOfImage(pick);
    if (pick.session == session && name == frame) {
      return pick;
    }
    images += (images.empty() ? "" : ", ") + name +
              (pick.session == 0 ? "" : " of session " + std::to_string(pick.session));
  }
  return Status::Error(option, anchor.name + " was not picked in " + frame,
                       images.empty() ? "it was picked nowhere" : "it was picked in " + images);
}

bool RemovePick(stage::Anchor& anchor, const stage::Pick& pick) {
  return std::erase_if(anchor.picks, [&](const stage::Pick& known) {
           return known.session == pick.session && known.frame_index == pick.frame_index &&
                  (known.frame.empty() || known.frame == pick.frame);
         }) > 0;
}

bool RemoveCheckPick(PlaceDocument& place, std::string_view point, const stage::Pick& pick) {
  const auto anchor = std::find_if(place.check_picks.begin(), place.check_picks.end(),
                                   [&](const stage::Anchor& a) { return a.name == point; });
  if (anchor == place.check_picks.end() || !RemovePick(*anchor, pick)) {
    return false;
  }
  if (anchor->picks.empty()) {
    place.check_picks.erase(anchor);
  }
  return true;
}

bool RemoveCornerPick(OccluderDocument& occluder, size_t corner, const stage::Pick& pick) {
  if (corner >= occluder.corners.size() || !RemovePick(occluder.corners[corner], pick)) {
    return false;
  }
  if (occluder.corners[corner].picks.empty()) {
    occluder.corners.erase(occluder.corners.begin() + static_cast<std::ptrdiff_t>(corner));
    for (size_t i = corner; i < occluder.corners.size(); ++i) {
      occluder.corners[i].name = CornerName(i);
    }
  }
  return true;
}

}  // namespace lararium::editor
