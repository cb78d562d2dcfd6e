#include "shared/vision/tracker.h"

#include <opencv2/core.hpp>

#include "shared/core/check.h"
#include "shared/vision/level_of_detail.h"
#include "shared/vision/localizer.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;

constexpr double kDarkMean = 8.0;  // grey level of 0..255 below which nothing shows

LocalizerOptions LocalizerOptionsOf(const TrackerOptions& options) {
  return {.search_checks = options.search_checks,
          .ratio = options.ratio,
          .inlier_threshold_px = options.inlier_threshold_px,
          .hypotheses = options.hypotheses,
          .min_inliers = options.min_inliers,
          .seed = options.seed};
}

class SiftTracker final : public PoseSource {
 public:
  SiftTracker(std::shared_ptr<const SceneDatabase> database,
              const CameraModel& camera,
              const TrackerOptions& options)
      : database_(std::move(database)),
        camera_(camera),
        localizer_(*database_, LocalizerOptionsOf(options)),
        detail_(options.feature_budget) {}

  TrackedFrame Track(const geometry::Frame& frame) override {
    TrackedFrame tracked;
    tracked.frame = frame;
    tracked.camera = CameraFor(frame);
    if (frame.grey.empty()) {
      tracked.reason = TrackReason::kTooFewFeatures;
    } else if (cv::mean(frame.grey)[0] < kDarkMean) {
      tracked.reason = TrackReason::kTooDark;
    } else {
      LocateWithDetail(tracked);
    }
    had_pose_ = had_pose_ || tracked.camera_from_map.has_value();
    tracked.state = tracked.camera_from_map ? TrackState::kTracking
                    : had_pose_             ? TrackState::kLost
                                            : TrackState::kSearching;
    return tracked;
  }

 private:
  CameraModel CameraFor(const geometry::Frame& frame) const {
    const bool same = frame.grey.empty() ||
                      (frame.grey.cols == camera_.width && frame.grey.rows == camera_.height);
    return same ? camera_ : camera_.Resized(frame.grey.cols, frame.grey.rows);
  }

  // The level of detail may save work but never cost a pose: where it fails, the
  // finest level has the last word on the same frame.
  void LocateWithDetail(TrackedFrame& tracked) {
    const bool finest = detail_.finest();
    Locate(detail_.options(), tracked);
    detail_.Observe(static_cast<size_t>(tracked.features));
    if (!tracked.camera_from_map && !finest) {
      Locate(detail_.finest_options(), tracked);
    }
  }

  void Locate(const FeatureOptions& options, TrackedFrame& tracked) {
    CHECK(extractor_.Extract(tracked.frame.grey, options, features_).ok());
    const Location location = localizer_.Locate(features_, tracked.camera);
    tracked.camera_from_map = location.camera_from_map;
    tracked.reason = location.reason;
    tracked.confidence = location.confidence;
    tracked.features = static_cast<int>(features_.size());
    tracked.matches = location.matches;
    tracked.inliers = location.inliers;
  }

  std::shared_ptr<const SceneDatabase> database_;
  CameraModel camera_;
  FeatureExtractor extractor_;
  Features features_;
  Localizer localizer_;
  LevelOfDetail detail_;
  bool had_pose_ = false;
};

}  // namespace

Status TrackerOptions::Validate() const {
  constexpr std::string_view kPlace = "tracker options";
  if (threads < 0 || threads > 1024) {
    return Status::Error(kPlace, "threads must lie between 0 and 1024");
  }
  if (feature_budget < 50 || feature_budget > 100000) {
    return Status::Error(kPlace, "feature_budget must lie between 50 and 100000");
  }
  if (search_checks < 1 || search_checks > 100000) {
    return Status::Error(kPlace, "search_checks must lie between 1 and 100000");
  }
  if (!(ratio > 0.0f && ratio <= 1.0f)) {
    return Status::Error(kPlace, "ratio must lie between 0 and 1");
  }
  if (!(inlier_threshold_px > 0.0f && inlier_threshold_px <= 100.0f)) {
    return Status::Error(kPlace, "inlier_threshold_px must lie between 0 and 100");
  }
  if (hypotheses < 1 || hypotheses > 100000) {
    return Status::Error(kPlace, "hypotheses must lie between 1 and 100000");
  }
  if (min_inliers < 4) {
    return Status::Error(kPlace, "min_inliers must be at least 4");
  }
  return Status();
}

Result<std::unique_ptr<PoseSource>> CreateTracker(
    std::vector<std::shared_ptr<const SceneDatabase>> maps,
    const CameraModel& camera,
    const TrackerOptions& options) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  LARARIUM_RETURN_IF_ERROR(camera.Validate());
  if (maps.empty()) {
    return Status::Error("tracker", "has no map", "train a place first");
  }
  for (const auto& map : maps) {
    CHECK(map != nullptr);
    if (map->points.size() < static_cast<size_t>(options.min_inliers)) {
      return Status::Error("scene database", "has too few points to track",
                           "train the place again");
    }
  }
  return std::unique_ptr<PoseSource>(
      std::make_unique<SiftTracker>(std::move(maps.front()), camera, options));
}

}  // namespace lararium::vision
