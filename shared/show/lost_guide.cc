#include "shared/show/lost_guide.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace lararium::show {
namespace {

constexpr int kPictureWidth = 480;
// A keyframe is easy to find if it observes at least this share of the largest number of observed
// points.
constexpr double kGoodShare = 0.5;

// [keyframes]: Number of observed points that tell where the camera is; 0 without an image.
std::vector<size_t> CountObservations(const vision::SceneDatabase& map) {
  std::vector<size_t> counts(map.keyframes.size(), 0);
  for (const vision::Observation& observation : map.observations) {
    counts[observation.keyframe] += map.HasLookalike(observation.point) ? 0 : 1;
  }
  for (size_t i = 0; i < counts.size(); ++i) {
    counts[i] = map.keyframes[i].grey.empty() ? 0 : counts[i];
  }
  return counts;
}

// The map's unit of length: the median distance of points from keyframes.
double TypicalDistance(const vision::SceneDatabase& map) {
  std::vector<double> distances;
  const size_t step = std::max<size_t>(1, map.observations.size() / 256);
  for (size_t i = 0; i < map.observations.size(); i += step) {
    const vision::Observation& o = map.observations[i];
    distances.push_back(
        (map.keyframes[o.keyframe].camera_from_map * map.points[o.point].cast<double>()).norm());
  }
  if (distances.empty()) {
    return 1.0;
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return std::max(*middle, 1e-9);
}

}  // namespace

std::optional<size_t> ChooseGuideView(const vision::SceneDatabase& map,
                                      const std::optional<geometry::Rigid3>& last_camera_from_map) {
  const std::vector<size_t> counts = CountObservations(map);
  const auto most = std::max_element(counts.begin(), counts.end());
  if (most == counts.end() || *most == 0) {
    return std::nullopt;
  }
  size_t best = static_cast<size_t>(most - counts.begin());
  if (!last_camera_from_map) {
    return best;
  }
  const double distance = TypicalDistance(map);
  double least = INFINITY;
  for (size_t i = 0; i < counts.size(); ++i) {
    if (static_cast<double>(counts[i]) < kGoodShare * static_cast<double>(*most)) {
      continue;
    }
    const geometry::Rigid3& pose = map.keyframes[i].camera_from_map;
    const double angle = pose.rotation.angularDistance(last_camera_from_map->rotation);
    const double away = (pose.Center() - last_camera_from_map->Center()).norm() / distance;
    if (angle + away < least) {
      least = angle + away;
      best = i;
    }
  }
  return best;
}

void LostGuide::Update(float opacity,
                       const vision::TrackedFrame& tracked,
                       const vision::SceneDatabase* map,
                       StagedGuide& guide) {
  if (tracked.camera_from_map) {
    last_camera_from_map_ = tracked.camera_from_map;
    last_map_ = map;
  }
  const bool begins = opacity > 0.0f && shown_.opacity <= 0.0f;
  shown_.opacity = opacity;
  if (begins) {
    ++shown_.picture_number;
    shown_.picture.release();
    const auto view =
        map == nullptr
            ? std::nullopt
            : ChooseGuideView(*map, map == last_map_ ? last_camera_from_map_ : std::nullopt);
    if (view) {
      const cv::Mat& grey = map->keyframes[*view].grey;
      const int width = std::min(kPictureWidth, grey.cols);
      cv::resize(grey, shown_.picture, cv::Size(width, std::max(1, width * grey.rows / grey.cols)),
                 0, 0, cv::INTER_AREA);
    }
  }
  if (!tracked.camera_from_map) {
    shown_.says = tracked.reason == vision::TrackReason::kTooDark ? StagedGuide::Says::kDark
                                                                  : StagedGuide::Says::kLookThere;
  }
  guide = shown_;
}

}  // namespace lararium::show
