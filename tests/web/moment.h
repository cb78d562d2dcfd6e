#pragma once

// A show at a moment of its drama, seen from a keyframe of its first place.

#include <algorithm>
#include <filesystem>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "shared/bundle/bundle.h"
#include "shared/show/show.h"

namespace lararium::show {

inline constexpr int kMomentWidth = 640;
inline constexpr int kMomentHeight = 480;

// Borrows log.
inline Result<std::unique_ptr<Show>> OpenAt(const std::filesystem::path& file,
                                            double seconds,
                                            Log& log) {
  constexpr float kFinest = 0.003f;  // metres
  LARARIUM_ASSIGN_OR_RETURN(std::optional<bundle::Bundle> bundle, bundle::Bundle::Open(file));
  LARARIUM_ASSIGN_OR_RETURN(ShowContent content, LoadShowContent(*bundle, {}, {}, kFinest));
  bundle.reset();
  // Where finer people are read in the background, it depends on the machine when they come.
  content.finer = {};
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<Show> show, Show::Create(std::move(content), {}, log));
  LARARIUM_RETURN_IF_ERROR(show->PrepareAt(seconds));
  show->detail().SetPictureSize(kMomentWidth, kMomentHeight);
  show->detail().SetSeenAround(true);
  return show;
}

// index: of the frame, of 30 a second. from: a keyframe as the view, before a grey background;
// nullopt: that of the first keyframe with an image, and this image.
inline vision::TrackedFrame ViewOf(const Show& show,
                                   int index,
                                   std::optional<size_t> from = std::nullopt) {
  const vision::SceneDatabase& map = *show.content().places.front().map;
  // Most keyframes have no image.
  const auto pictured = std::find_if(map.keyframes.begin(), map.keyframes.end(),
                                     [](const auto& keyframe) { return !keyframe.grey.empty(); });
  const vision::Keyframe& keyframe = from                              ? map.keyframes.at(*from)
                                     : pictured == map.keyframes.end() ? map.keyframes.front()
                                                                       : *pictured;
  vision::TrackedFrame tracked;
  tracked.camera = map.camera.GuessForImages(kMomentWidth, kMomentHeight);
  tracked.camera_from_map = keyframe.camera_from_map;
  tracked.state = vision::TrackState::kTracking;
  tracked.frame.index = index;
  tracked.frame.capture_time = index / 30.0;
  if (from) {
    tracked.frame.bgr.create(kMomentHeight, kMomentWidth, CV_8UC3);
    tracked.frame.bgr.setTo(cv::Scalar::all(110.0));
  } else if (!keyframe.grey.empty()) {
    cv::cvtColor(keyframe.grey, tracked.frame.bgr, cv::COLOR_GRAY2BGR);
  }
  return tracked;
}

}  // namespace lararium::show
