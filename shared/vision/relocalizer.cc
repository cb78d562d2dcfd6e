#include "shared/vision/relocalizer.h"

#include <optional>

#include "shared/core/check.h"

namespace lararium::vision {
namespace {

LocalizerOptions LocalizerOptionsOf(const TrackerOptions& options) {
  return {.search_checks = options.search_checks,
          .ratio = options.ratio,
          .inlier_threshold_px = options.inlier_threshold_px,
          .hypotheses = options.hypotheses,
          .min_inliers = options.min_inliers,
          .seed = options.seed};
}

}  // namespace

Relocalizer::Relocalizer(std::span<const std::shared_ptr<const SceneDatabase>> maps,
                         const TrackerOptions& options)
    : locator_(maps, LocalizerOptionsOf(options)), detail_(options.feature_budget) {}

Located Relocalizer::Find(const cv::Mat& grey, const CameraGuess& guess) {
  const bool finest = detail_.finest();
  Located located = Locate(grey, guess, detail_.options());
  const size_t features = features_.size();
  const bool again = !located.location.camera_from_map && !finest;
  if (again) {
    located = Locate(grey, guess, detail_.finest_options());
  }
  const Location& location = located.location;
  std::optional<PoseQuality> pose;
  if (location.camera_from_map) {
    // If only the finest options gave a pose, the usual options count as having given a poor one.
    pose = again ? PoseQuality{} : PoseQuality{location.inliers, location.expected_error_px};
  }
  detail_.Observe(features, pose);
  return located;
}

Located Relocalizer::Locate(const cv::Mat& grey,
                            const CameraGuess& guess,
                            const FeatureOptions& options) {
  CHECK(extractor_.Extract(grey, options, features_).ok());
  return locator_.Locate(features_, guess);
}

}  // namespace lararium::vision
