#include "editor/train/frame_locator.h"

#include <algorithm>

#include "editor/train/matching.h"
#include "editor/train/resection.h"
#include "shared/core/check.h"

namespace lararium::train {
namespace {

constexpr size_t kKeyframes = 4;  // that a frame is matched with

}  // namespace

FrameLocator::FrameLocator(const Reconstruction& reconstruction,
                           std::span<const TrainingImage> images)
    : reconstruction_(reconstruction) {
  CHECK(images.size() == reconstruction.image_count());
  for (const uint32_t image : reconstruction.LocatedImages()) {
    View& view = views_.emplace_back();
    view.frame_index = images[image].frame_index;
    for (const uint32_t element : reconstruction.ElementsOf(image)) {
      if (reconstruction.Observed(element)) {
        const uint32_t feature = reconstruction.tracks().elements[element].feature;
        view.descriptors.push_back(images[image].features.descriptors[feature]);
        view.tracks.push_back(reconstruction.TrackOf(element));
      }
    }
  }
}

std::optional<geometry::Rigid3> FrameLocator::Locate(const cv::Mat& grey,
                                                     int64_t frame_index) const {
  vision::FeatureOptions options;
  options.first_octave = 0;
  options.max_features = 1500;
  const Result<vision::Features> features = vision::ExtractFeatures(grey, options);
  if (!features.ok()) {
    return std::nullopt;
  }
  const auto after =
      std::lower_bound(views_.begin(), views_.end(), frame_index,
                       [](const View& view, int64_t index) { return view.frame_index < index; });
  const auto position = static_cast<size_t>(after - views_.begin());
  const size_t begin = position - std::min(position, kKeyframes / 2);
  const size_t end = std::min(views_.size(), begin + kKeyframes);

  std::vector<Eigen::Vector2d> pixels;
  std::vector<Eigen::Vector3d> points;
  std::vector<std::pair<uint32_t, uint32_t>> seen;  // feature, track
  for (size_t i = begin; i < end; ++i) {
    for (const FeatureMatch& match :
         MatchDescriptors(features->descriptors, views_[i].descriptors, 0.8f)) {
      seen.emplace_back(match.a, views_[i].tracks[match.b]);
    }
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  for (const auto& [feature, track] : seen) {
    const vision::Keypoint& keypoint = features->keypoints[feature];
    pixels.emplace_back(keypoint.x, keypoint.y);
    points.push_back(reconstruction_.Point(track));
  }
  const std::optional<Resection> resection =
      LocateImage(reconstruction_.camera(), pixels, points, ResectionOptions());
  return resection ? std::optional(resection->camera_from_map) : std::nullopt;
}

}  // namespace lararium::train
