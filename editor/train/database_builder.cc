#include "editor/train/database_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "editor/train/budget.h"
#include "editor/train/camera_transfer.h"
#include "editor/train/lookalikes.h"
#include "editor/train/photometric_reference.h"
#include "shared/core/check.h"

namespace lararium::train {
namespace {

using vision::Descriptor;

// The candidate with the smallest sum of distances to the others.
size_t MostCentral(std::span<const Descriptor> candidates) {
  std::vector<uint64_t> sums(candidates.size(), 0);
  for (size_t i = 0; i < candidates.size(); ++i) {
    for (size_t j = i + 1; j < candidates.size(); ++j) {
      const uint32_t distance = vision::SquaredDistance(candidates[i], candidates[j]);
      sums[i] += distance;
      sums[j] += distance;
    }
  }
  return static_cast<size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
}

class Builder {
 public:
  Builder(const Reconstruction& reconstruction,
          std::span<const TrainingImage> images,
          const DatabaseOptions& options)
      : reconstruction_(reconstruction), images_(images), options_(options) {}

  vision::SceneDatabase Build() {
    const TrainingCamera& camera = reconstruction_.cameras()[reconstruction_.MainCamera()];
    // Where its images do not reach, its distortion may fold back.
    database_.camera = camera.model.Validate().ok() ? camera.model : ModelOfArea(camera);
    database_.readout = reconstruction_.readout();
    AddKeyframes();
    database_.descriptor_begin.push_back(0);
    double error_sum = 0.0;
    for (const uint32_t track : reconstruction_.TracksWithPoints()) {
      error_sum += AddPoint(track);
    }
    std::sort(database_.observations.begin(), database_.observations.end(),
              [](const vision::Observation& a, const vision::Observation& b) {
                return a.keyframe != b.keyframe ? a.keyframe < b.keyframe : a.point < b.point;
              });
    ConvertToMainCamera();
    if (!database_.observations.empty()) {
      database_.mean_reprojection_error_px =
          error_sum / static_cast<double>(database_.observations.size());
    }
    FillPhotometry(database_, bgr_);
    vision::ForestOptions forest;
    forest.seed = options_.seed;
    database_.forest = vision::BuildForest(database_.descriptors, forest);
    database_.lookalikes = FindLookalikes(database_, options_.seed);
    if (database_.points.size() <= static_cast<size_t>(options_.max_points)) {
      return std::move(database_);
    }
    BudgetOptions budget;
    budget.max_points = options_.max_points;
    budget.seed = options_.seed;
    return Prune(database_, budget);
  }

 private:
  void AddKeyframes() {
    keyframe_of_image_.resize(images_.size());
    for (const uint32_t image : reconstruction_.LocatedImages()) {
      keyframe_of_image_[image] = static_cast<uint32_t>(database_.keyframes.size());
      image_of_keyframe_.push_back(image);
      vision::Keyframe& keyframe = database_.keyframes.emplace_back();
      keyframe.frame_index = images_[image].frame_index;
      keyframe.name = images_[image].name;
      keyframe.session = options_.session;
      keyframe.camera_from_map = reconstruction_.camera_from_map(image);
      keyframe.motion = reconstruction_.motion(image);
      keyframe.grey = images_[image].grey;
      bgr_.push_back(images_[image].bgr);
    }
  }

  // Converts what other cameras saw. Observations that the main camera could not have made go.
  void ConvertToMainCamera() {
    if (reconstruction_.cameras().size() == 1) {
      return;
    }
    std::vector<vision::Observation> converted;
    auto begin = database_.observations.begin();
    for (uint32_t k = 0; k < database_.keyframes.size(); ++k) {
      const auto end = std::find_if(begin, database_.observations.end(),
                                    [&](const vision::Observation& o) { return o.keyframe != k; });
      std::vector<vision::Observation> of_keyframe(begin, end);
      begin = end;
      const uint32_t image = image_of_keyframe_[k];
      const geometry::CameraModel& camera = reconstruction_.camera(image);
      if (camera != database_.camera) {
        of_keyframe = ObservationsIn(database_.camera, camera, std::move(of_keyframe));
        Resample(camera, database_.camera, std::array{&database_.keyframes[k].grey, &bgr_[k]});
      }
      converted.insert(converted.end(), of_keyframe.begin(), of_keyframe.end());
    }
    database_.observations = std::move(converted);
  }

  // Adds the point of a track. Returns the sum of its reprojection errors.
  double AddPoint(uint32_t track) {
    const Eigen::Vector3d point = reconstruction_.Point(track);
    const auto index = static_cast<uint32_t>(database_.points.size());
    Eigen::Vector3d towards_viewers = Eigen::Vector3d::Zero();
    std::vector<Descriptor> candidates;
    double error_sum = 0.0;
    const Tracks& tracks = reconstruction_.tracks();
    for (uint32_t element = tracks.begin[track]; element < tracks.begin[track + 1]; ++element) {
      if (!reconstruction_.Observed(element)) {
        continue;
      }
      const auto [image, feature] = tracks.elements[element];
      const vision::Keypoint& keypoint = images_[image].features.keypoints[feature];
      database_.observations.push_back(
          {index, keyframe_of_image_[image], keypoint.x, keypoint.y, keypoint.scale});
      candidates.push_back(images_[image].features.descriptors[feature]);
      towards_viewers +=
          (reconstruction_.camera_from_map(image).Center() - point).stableNormalized();
      error_sum += std::sqrt(reconstruction_.SquaredErrorPx(element, point));
    }
    CHECK(candidates.size() >= 2);
    if (towards_viewers.norm() < 1e-9) {
      towards_viewers = Eigen::Vector3d::UnitZ();  // The point was seen from opposite sides.
    }
    database_.points.push_back(point.cast<float>());
    database_.normals.push_back(towards_viewers.normalized().cast<float>());
    database_.observation_counts.push_back(static_cast<uint32_t>(candidates.size()));
    database_.session_masks.push_back(1u << options_.session);
    std::vector<Descriptor> chosen;
    AddDistinctDescriptors(candidates, static_cast<size_t>(options_.max_descriptors_per_point),
                           chosen);
    for (const Descriptor& descriptor : chosen) {
      database_.descriptors.push_back(descriptor);
      database_.descriptor_point.push_back(index);
    }
    database_.descriptor_begin.push_back(static_cast<uint32_t>(database_.descriptors.size()));
    return error_sum;
  }

  const Reconstruction& reconstruction_;
  std::span<const TrainingImage> images_;
  DatabaseOptions options_;
  vision::SceneDatabase database_;
  std::vector<uint32_t> keyframe_of_image_;  // [image]
  std::vector<uint32_t> image_of_keyframe_;  // [keyframe]
  std::vector<cv::Mat> bgr_;                 // [keyframe]
};

}  // namespace

namespace {

constexpr uint32_t kNear = 110 * 110;  // Squared distance; descriptors have length 512.

}  // namespace

bool LookAlike(const Descriptor& a, const Descriptor& b) {
  return vision::SquaredDistance(a, b) < kNear;
}

void AddDistinctDescriptors(std::span<const Descriptor> candidates,
                            size_t max_count,
                            std::vector<Descriptor>& chosen) {
  if (candidates.empty()) {
    return;
  }
  std::vector<uint32_t> nearest(candidates.size(), std::numeric_limits<uint32_t>::max());
  const auto note = [&](const Descriptor& taken) {
    for (size_t i = 0; i < candidates.size(); ++i) {
      nearest[i] = std::min(nearest[i], vision::SquaredDistance(candidates[i], taken));
    }
  };
  for (const Descriptor& taken : chosen) {
    note(taken);
  }
  if (chosen.empty()) {
    chosen.push_back(candidates[MostCentral(candidates)]);
    note(chosen.back());
  }
  while (chosen.size() < max_count) {
    const auto farthest = std::max_element(nearest.begin(), nearest.end());
    if (*farthest < kNear) {
      break;
    }
    chosen.push_back(candidates[static_cast<size_t>(farthest - nearest.begin())]);
    note(chosen.back());
  }
}

vision::SceneDatabase BuildDatabase(const Reconstruction& reconstruction,
                                    std::span<const TrainingImage> images,
                                    const DatabaseOptions& options) {
  CHECK(images.size() == reconstruction.image_count());
  return Builder(reconstruction, images, options).Build();
}

}  // namespace lararium::train
