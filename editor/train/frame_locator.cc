#include "editor/train/frame_locator.h"

#include <algorithm>
#include <cmath>

#include "editor/train/matching.h"
#include "editor/train/resection.h"
#include "shared/core/check.h"

namespace lararium::train {
namespace {

constexpr size_t kKeyframes = 4;  // that a frame is matched with

double Median(std::vector<double> values) {
  if (values.empty()) {
    return 0.0;
  }
  const auto middle = values.begin() + static_cast<ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

LocatedView DescribeImage(const Reconstruction& reconstruction, uint32_t image) {
  LocatedView view;
  if (!reconstruction.Located(image)) {
    return view;
  }
  view.camera_from_map = reconstruction.camera_from_map(image);
  std::vector<double> errors;
  for (const uint32_t element : reconstruction.ElementsOf(image)) {
    if (reconstruction.Observed(element)) {
      const Eigen::Vector3d& point = reconstruction.Point(reconstruction.TrackOf(element));
      errors.push_back(std::sqrt(reconstruction.SquaredErrorPx(element, point)));
    }
  }
  view.observations = static_cast<int>(errors.size());
  view.median_error_px = Median(std::move(errors));
  return view;
}

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

LocatedView FrameLocator::Locate(const cv::Mat& grey, int64_t frame_index) const {
  LocatedView view;
  vision::FeatureOptions options;
  options.first_octave = 0;
  options.max_features = 1500;
  const Result<vision::Features> features = vision::ExtractFeatures(grey, options);
  if (!features.ok()) {
    return view;
  }
  view.features = static_cast<int>(features->size());
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
  if (!resection) {
    return view;
  }
  view.camera_from_map = resection->camera_from_map;
  view.observations = static_cast<int>(resection->inliers.size());
  std::vector<double> errors;
  for (const uint32_t i : resection->inliers) {
    const auto projected = reconstruction_.camera().Project(resection->camera_from_map * points[i]);
    errors.push_back(projected ? (*projected - pixels[i]).norm() : 0.0);
  }
  view.median_error_px = Median(std::move(errors));
  return view;
}

}  // namespace lararium::train
