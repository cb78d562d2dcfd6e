#include "shared/vision/tracker.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <span>

#include "shared/core/check.h"
#include "shared/vision/background/background_search.h"
#include "shared/vision/camera_filter.h"
#include "shared/vision/gain_estimator.h"
#include "shared/vision/motion_model.h"
#include "shared/vision/patch_tracker.h"
#include "shared/vision/relocalizer.h"
#include "shared/vision/rotation_estimator.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

constexpr double kDarkMean = 8.0;    // Darker images (mean grey level 0..255) are not tracked.
constexpr double kLongestGap = 8.0;  // Frame times over which motion is predicted at most.
constexpr double kLeapPx = 30.0;     // The view changed if it moves more than this per frame.
constexpr double kFewAgree = 0.5;    // Share of agreeing patches below which many do not agree.
constexpr float kLeastUnconfirmed = 0.97f;  // Confidence of a pose that no patches confirm.
constexpr double kTwoMeaningsPx = 3.0;      // Poses farther apart than this contradict each other.

// A camera with its lens at a pose.
struct PosedModel {
  const CameraModel& camera;
  const Rigid3& camera_from_map;
};

// Mean distance, in pixels, between the projections of points at a depth by two cameras.
double DistancePx(const PosedModel& a, const PosedModel& b, double depth) {
  constexpr int kSteps = 4;
  const Rigid3 b_from_a = b.camera_from_map * a.camera_from_map.Inverse();
  double sum = 0.0;
  for (int row = 0; row < kSteps; ++row) {
    for (int column = 0; column < kSteps; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) / kSteps * a.camera.width,
                                  (row + 0.5) / kSteps * a.camera.height);
      const Eigen::Vector2d plane = a.camera.PlaneFromPixel(pixel);
      const Eigen::Vector3d moved = b_from_a * (depth * plane.homogeneous());
      if (moved.z() <= 0.0) {
        return std::numeric_limits<double>::infinity();
      }
      sum += (b.camera.PixelFromPlane(moved.hnormalized()) - pixel).norm();
    }
  }
  return sum / (kSteps * kSteps);
}

class Tracker final : public PoseSource {
 public:
  // tracked: the maps prepared for following; empty if options.follow is false.
  Tracker(std::vector<std::shared_ptr<const SceneDatabase>> maps,
          std::vector<std::shared_ptr<const TrackedMap>> tracked,
          const CameraModel& camera,
          const TrackerOptions& options,
          std::unique_ptr<BackgroundSearch> background)
      : options_(options),
        camera_(camera, options.known_camera),
        maps_(std::move(maps)),
        relocalizer_(maps_, options) {
    if (options.follow) {
      for (auto& map : tracked) {
        patch_trackers_.push_back(std::make_unique<PatchTracker>(std::move(map)));
      }
      background_ =
          background ? std::move(background) : MakeBackgroundSearch(relocalizer_, options.threads);
    }
  }

  TrackedFrame Track(const geometry::Frame& frame) override {
    TrackedFrame tracked;
    tracked.frame = frame;
    now_ = clock_.Time(frame);
    if (!frame.grey.empty()) {
      camera_.SetSize(frame.grey.cols, frame.grey.rows);
    }
    tracked.camera = camera_.now().model;
    tracked.gain = last_gain_;
    by_patches_ = false;
    found_in_.reset();
    if (find_anew_.exchange(false)) {
      motion_.Forget();
      checked_pose_.reset();  // The result of running background work is ignored.
    }
    if (frame.grey.empty()) {
      tracked.reason = TrackReason::kTooFewFeatures;
    } else if (cv::mean(frame.grey)[0] < kDarkMean) {
      tracked.reason = TrackReason::kTooDark;
    } else if (options_.follow) {
      FollowOrFind(tracked);
    } else {
      Find(tracked);
    }
    if (!tracked.camera_from_map) {
      motion_.Forget();
    }
    had_pose_ = had_pose_ || tracked.camera_from_map.has_value();
    tracked.state = tracked.camera_from_map ? TrackState::kTracking
                    : had_pose_             ? TrackState::kLost
                                            : TrackState::kSearching;
    return tracked;
  }

  void Relocalize() override { find_anew_ = true; }

  void Seen(std::vector<SeenPoint>& seen) const override {
    seen.clear();
    if (by_patches_) {
      const std::span<const SeenPoint> patches = patch_trackers_[map_]->seen();
      seen.assign(patches.begin(), patches.end());
    } else if (found_in_) {
      for (const LocatedPoint& located : relocalizer_.points(*found_in_)) {
        seen.push_back({located.point, located.pixel});
      }
    }
  }

  void SetOccluders(uint32_t map, std::span<const OccluderMesh> meshes) override {
    CHECK(map < maps_.size());
    if (options_.follow) {
      patch_trackers_[map]->SetOccluders(meshes);
    }
  }

 private:
  void FollowOrFind(TrackedFrame& tracked) {
    const cv::Mat& grey = tracked.frame.grey;
    // One level more than the patch tracker's coarsest, for estimating the camera's rotation.
    const int levels = CoarsestLevel(grey.cols) + 2;
    pyramid_.Build(grey, levels);
    if (checked_image_.levels() == 0) {
      checked_image_.Build(grey, levels);  // Allocates memory for later.
    }
    bool anchored = false;
    if (!Follow(tracked)) {
      Find(tracked);
      anchored = tracked.camera_from_map && Anchor(tracked);
      if (tracked.camera_from_map && !anchored && tracked.confidence < kLeastUnconfirmed) {
        // In a mirrored or rebuilt room, matches may agree on a pose that the image contradicts.
        tracked.camera_from_map.reset();
        tracked.reason = TrackReason::kNoConsistentPose;
        tracked.confidence = 0.0f;
        tracked.inliers = 0;
        found_in_.reset();
      }
    }
    pyramid_.level(pyramid_.levels() - 1).copyTo(small_before_);
    if (tracked.camera_from_map) {
      const Rigid3& pose = *tracked.camera_from_map;
      motion_.Add(now_, pose);
      if (anchored) {
        patch_trackers_[map_]->Merge(pyramid_, tracked.camera, pose, relocalizer_.points(map_),
                                     pose);
      }
      CheckInBackground(tracked);
    }
  }

  bool Follow(TrackedFrame& tracked) {
    if (!motion_.has_pose()) {
      return false;
    }
    const double frames = now_ - motion_.last_time();
    if (frames <= 0.0 || frames > kLongestGap) {
      return false;
    }
    const Rigid3 before = motion_.last_pose();
    const Rigid3 motion = motion_.Motion(frames);
    std::array<Rigid3, 2> predictions = {motion * before};
    size_t count = 1;
    const CameraEstimate camera = camera_.Predict(frames);
    if (const auto turn = EstimateTurn(camera.model, motion.rotation)) {
      predictions[count++] = Rigid3{*turn, motion.translation} * before;
    }
    const FollowedPose followed = patch_trackers_[map_]->Follow(
        pyramid_, camera, std::span(predictions.data(), count), &before, frames);
    if (!followed.reliable ||
        (camera_.MaySwitch() && Leaps(std::span(predictions.data(), count), followed))) {
      return false;
    }
    Report(followed, tracked);
    tracked.followed = true;
    constexpr int64_t kDoubtInterval = 5;  // frames
    if (camera_.held() && (camera_.contradicted() || tracked.frame.index % kDoubtInterval == 0)) {
      camera_.Contradict(patch_trackers_[map_]->EstimateCamera(camera_.Doubted()));
    }
    if (share_ < kFewAgree &&
        DistancePx({tracked.camera, before}, {tracked.camera, followed.camera_from_map}, depth_) >
            kLeapPx) {
      // The patches were chosen for another view.
      Refine(tracked, &before, frames);
    }
    return true;
  }

  // Whether a pose is too far from all predictions. The fewer patches agree with it, the nearer it
  // has to be. Before a plane, a lens of another focal length looks like a leap of the camera.
  static bool Leaps(std::span<const Rigid3> predictions, const FollowedPose& followed) {
    const double limit = kLeapPx * followed.share();
    return std::none_of(predictions.begin(), predictions.end(), [&](const Rigid3& prediction) {
      return DistancePx({followed.camera.model, prediction},
                        {followed.camera.model, followed.camera_from_map},
                        followed.evidence.depths[1]) < limit;
    });
  }

  std::optional<Eigen::Quaterniond> EstimateTurn(const CameraModel& camera,
                                                 const Eigen::Quaterniond& start) const {
    const cv::Mat& small = pyramid_.level(pyramid_.levels() - 1);
    if (small_before_.size() != small.size()) {
      return std::nullopt;
    }
    const CameraModel small_camera = camera.Resized(small.cols, small.rows);
    const auto expected = EstimateRotation(small_before_, small, small_camera, start);
    const auto still =
        EstimateRotation(small_before_, small, small_camera, Eigen::Quaterniond::Identity());
    if (expected && still) {
      return (expected->noise <= still->noise ? *expected : *still).now_from_before;
    }
    return expected ? std::optional(expected->now_from_before)
           : still  ? std::optional(still->now_from_before)
                    : std::nullopt;
  }

  void Find(TrackedFrame& tracked) {
    if (background_) {
      background_->Drop();  // The frame in the background belongs to the lost tracking.
    }
    const Located located = relocalizer_.Find(tracked.frame.grey, camera_.Guess());
    const Location& location = located.location;
    tracked.map = located.map;
    tracked.camera_from_map = location.camera_from_map;
    tracked.reason = location.reason;
    tracked.confidence = location.confidence;
    tracked.covariance = location.covariance;
    tracked.features = relocalizer_.features();
    tracked.matches = location.matches;
    tracked.inliers = location.inliers;
    if (location.camera_from_map) {
      found_in_ = located.map;
      tracked.camera = location.camera.model;
      camera_.Found(location.camera);
    }
  }

  // Starts frame-to-frame tracking from a pose found without a prior. Refines the pose if the
  // patches agree with it.
  bool Anchor(TrackedFrame& tracked) {
    map_ = tracked.map;
    checked_pose_.reset();
    motion_.Forget();
    return Refine(tracked, nullptr, 1.0);
  }

  // Chooses patches for the pose and aligns them. Returns whether they agree with it.
  bool Refine(TrackedFrame& tracked, const Rigid3* before, double frames) {
    const Rigid3 rough = *tracked.camera_from_map;
    const CameraModel camera = tracked.camera;
    PatchTracker& patch_tracker = *patch_trackers_[map_];
    patch_tracker.Start(tracked.camera, rough);
    const FollowedPose followed =
        patch_tracker.Follow(pyramid_, camera_.now(), std::span(&rough, 1), before, frames);
    if (followed.reliable &&
        DistancePx({camera, rough}, {followed.camera.model, followed.camera_from_map},
                   followed.evidence.depths[1]) < kTwoMeaningsPx) {
      Report(followed, tracked);
      return true;
    }
    return false;
  }

  void Report(const FollowedPose& followed, TrackedFrame& tracked) {
    camera_.Update(followed.camera);
    tracked.camera = followed.camera.model;
    if (followed.motion) {
      tracked.rolling_shutter = RollingShutter{followed.camera.readout, *followed.motion};
    }
    tracked.map = map_;
    tracked.camera_from_map = followed.camera_from_map;
    tracked.reason = TrackReason::kNone;
    tracked.covariance = followed.evidence.covariance.topLeftCorner<6, 6>();
    tracked.confidence = static_cast<float>(PoseConfidence(tracked.camera, followed.evidence));
    tracked.features = followed.expected;
    tracked.matches = followed.expected;
    tracked.inliers = followed.agreeing;
    if (const auto gain =
            gain_.Estimate(tracked.frame.bgr, *maps_[map_], patch_trackers_[map_]->seen())) {
      last_gain_ = *gain;
    }
    tracked.gain = last_gain_;
    tracked.shutter = patch_trackers_[map_]->shutter();
    share_ = followed.share();
    blur_px_ = followed.blur_px;
    depth_ = followed.evidence.depths[1];
    by_patches_ = true;
  }

  // From time to time a frame is also located without a prior, because tracking can lock on to the
  // wrong part of a repetitive scene. If the two poses contradict each other, patches decide which
  // one is right; if they agree, the points found are merged into the patch tracker.
  void CheckInBackground(TrackedFrame& tracked) {
    constexpr int64_t kJoinAfter = 6;  // frames
    // Frames between checks. The interval limits how long an error lasts; a check takes about 30 ms
    // of another thread.
    constexpr int64_t kCalmInterval = 60;
    constexpr int64_t kDoubtInterval = 30;
    constexpr double kCalmShare = 0.5;
    const int64_t index = tracked.frame.index;
    if (background_->busy()) {
      const bool due = index >= checked_index_ + kJoinAfter || index < checked_index_;
      if (options_.background == BackgroundWork::kJoined && !due) {
        return;
      }
      const auto located = background_->Take(due && options_.background == BackgroundWork::kJoined);
      if (located) {
        Compare(*located, tracked);
      }
      return;
    }
    const int64_t interval = share_ < kCalmShare ? kDoubtInterval : kCalmInterval;
    if (!tracked.followed) {
      checked_index_ = index;  // This frame was itself located without a prior.
    } else if (index >= checked_index_ + interval || index < checked_index_) {
      checked_index_ = index;
      checked_pose_ = *tracked.camera_from_map;
      checked_camera_ = tracked.camera;
      checked_blur_px_ = blur_px_;
      std::swap(checked_image_, pyramid_);
      background_->Begin(tracked.frame.grey, camera_.PresentGuess());
    }
  }

  // Compares the pose found in the background with the tracked pose of the same frame.
  void Compare(const Located& located, TrackedFrame& tracked) {
    if (!located.location.camera_from_map || !checked_pose_) {
      return;  // Nothing was found, or tracking was restarted in the meantime.
    }
    const Rigid3& found = *located.location.camera_from_map;
    if (located.map == map_ &&
        DistancePx({checked_camera_, *checked_pose_}, {located.location.camera.model, found},
                   depth_) < kTwoMeaningsPx + 4.0 * located.location.expected_error_px) {
      constexpr double kMostBlurPx = 2.0;  // Patches of a more blurred image are not usable.
      if (checked_blur_px_ < kMostBlurPx) {
        patch_trackers_[map_]->Merge(checked_image_, checked_camera_, *checked_pose_,
                                     background_->points(), *tracked.camera_from_map);
      }
      return;
    }
    // Both poses are tested with newly chosen patches, because tracking has long dropped the
    // patches that contradict its pose.
    const Rigid3 ours = *tracked.camera_from_map;
    Rigid3 since = ours * checked_pose_->Inverse();
    if (located.map != map_) {
      since.translation.setZero();  // Each map has its own unit of length.
    }
    const Rigid3 theirs = since * found;
    const double our_share = FollowAnew(map_, ours).share();
    const FollowedPose followed = FollowAnew(located.map, theirs);
    if (followed.reliable && followed.share() > our_share) {
      if (located.map == map_) {
        motion_.Correct(followed.camera_from_map);
      } else {
        motion_.Forget();
        motion_.Add(now_, followed.camera_from_map);
      }
      map_ = located.map;
      Report(followed, tracked);
      tracked.followed = false;
    } else if (located.map == map_) {
      patch_trackers_[map_]->Start(tracked.camera, ours);
    }
  }

  FollowedPose FollowAnew(uint32_t map, const Rigid3& pose) {
    const CameraEstimate& camera = camera_.now();
    patch_trackers_[map]->Start(camera.model, pose);
    return patch_trackers_[map]->Follow(pyramid_, camera, std::span(&pose, 1), nullptr, 1.0);
  }

  TrackerOptions options_;
  CameraFilter camera_;
  std::vector<std::shared_ptr<const SceneDatabase>> maps_;
  Relocalizer relocalizer_;
  std::vector<std::unique_ptr<PatchTracker>> patch_trackers_;  // [maps]
  ImagePyramid pyramid_;
  cv::Mat small_before_;
  FrameClock clock_;
  double now_ = 0.0;  // The time of the frame, in frame times.
  MotionModel motion_;
  GainEstimator gain_;
  std::array<float, 3> last_gain_ = {1.0f, 1.0f, 1.0f};
  uint32_t map_ = 0;
  double share_ = 0.0;  // Share of agreeing patches.
  double depth_ = 1.0;  // Median depth of the visible points, map units.
  double blur_px_ = 0.0;
  bool had_pose_ = false;
  std::atomic<bool> find_anew_ = false;
  bool by_patches_ = false;           // The last pose comes from patch_trackers_[map_].
  std::optional<uint32_t> found_in_;  // The map in which relocalizer_ located the last frame.

  int64_t checked_index_ = 0;  // Index of the frame that was last located without a prior.
  // Tracked pose of the frame in the background; none if tracking was restarted in the meantime.
  std::optional<Rigid3> checked_pose_;
  CameraModel checked_camera_;
  ImagePyramid checked_image_;
  double checked_blur_px_ = 0.0;
  std::unique_ptr<BackgroundSearch> background_;
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

namespace {

Status Validate(std::span<const std::shared_ptr<const SceneDatabase>> maps,
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
  return Status();
}

}  // namespace

Result<std::unique_ptr<PoseSource>> CreateTracker(
    std::vector<std::shared_ptr<const SceneDatabase>> maps,
    const CameraModel& camera,
    const TrackerOptions& options,
    std::unique_ptr<BackgroundSearch> background) {
  LARARIUM_RETURN_IF_ERROR(Validate(maps, camera, options));
  std::vector<std::shared_ptr<const TrackedMap>> tracked;
  if (options.follow) {
    for (const auto& map : maps) {
      tracked.push_back(std::make_shared<const TrackedMap>(map));
    }
  }
  return std::unique_ptr<PoseSource>(std::make_unique<Tracker>(
      std::move(maps), std::move(tracked), camera, options, std::move(background)));
}

Result<std::unique_ptr<PoseSource>> CreateTracker(
    std::vector<std::shared_ptr<const TrackedMap>> maps,
    const CameraModel& camera,
    const TrackerOptions& options,
    std::unique_ptr<BackgroundSearch> background) {
  CHECK(options.follow);
  std::vector<std::shared_ptr<const SceneDatabase>> databases;
  for (const auto& map : maps) {
    databases.push_back(map->shared_database());
  }
  LARARIUM_RETURN_IF_ERROR(Validate(databases, camera, options));
  return std::unique_ptr<PoseSource>(std::make_unique<Tracker>(
      std::move(databases), std::move(maps), camera, options, std::move(background)));
}

}  // namespace lararium::vision
