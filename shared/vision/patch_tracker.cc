#include "shared/vision/patch_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/vision/patch_tracker_parts.h"

namespace lararium::vision {
namespace {

using geometry::CameraModel;
using geometry::Rigid3;

// The conditions for an honest pose, together with kLeastShare.
constexpr int kLeastAgreeing = 20;
constexpr int kLeastCells = 6;  // Cells with agreeing patches, out of kSpreadColumns x kSpreadRows.
constexpr int kSpreadColumns = 6;
constexpr int kSpreadRows = 5;
constexpr double kLargestTrackedErrorPx = 3.0;

constexpr int kMostFailures = 4;
constexpr uint32_t kAimInterval = 8;  // Frames between searches for a better keyframe of a patch.

}  // namespace

PatchTracker::PatchTracker(std::shared_ptr<const TrackedMap> map)
    : map_(std::move(map)), not_before_(map_->database().points.size(), 0) {
  slots_.reserve(kMostSlots);
  for (Fit* fit : {&fit_, &searched_}) {
    fit->observations.reserve(kMostSlots);
    fit->matches.reserve(kMostSlots);
    fit->pose.squares.reserve(kMostSlots);
    fit->pose.in_camera.reserve(kMostSlots);
  }
  seen_.reserve(kMostSlots);
  depths_.reserve(kMostSlots);
  const auto keyframes = static_cast<uint32_t>(map_->database().keyframes.size());
  for (uint32_t k = 0; k < keyframes; ++k) {
    scale_ += map_->median_depth(k) / keyframes;
  }
}

FollowedPose PatchTracker::Follow(const ImagePyramid& image,
                                  const CameraModel& camera,
                                  std::span<const Rigid3> predictions,
                                  const Rigid3* before,
                                  double frames) {
  FollowedPose result;
  ++now_;
  has_motion_ = before != nullptr;
  if (before != nullptr) {
    before_ = *before;
    frames_ = frames;
  }
  HideSlots(predictions[0].Center());
  Rigid3 pose = BestPrediction(image, camera, predictions);
  const int coarsest = Coarsest(image);
  int finest = 0;
  for (int level = coarsest; level >= finest; --level) {
    SetMotion(pose);
    finest = std::min(FinestLevel(camera, pose), level);
    const int wanted = level == finest ? 1000 : level == coarsest ? 60 : 100;
    const int stride = std::max(1, static_cast<int>(slots_.size()) / wanted);
    Rigid3 moved = pose;
    bool found = RunLevel(image, camera, level, stride, moved, result.expected);
    if (level == coarsest && (!found || 3 * fit_.pose.inliers < result.expected)) {
      Rigid3 searched = pose;
      if (SearchLevel(image, camera, level, stride, found ? fit_.pose.inliers : 0, searched)) {
        moved = searched;
        found = true;
      }
    }
    if (found) {
      pose = moved;
    } else if (level == finest) {
      return result;
    }
  }
  result.camera_from_map = pose;
  result.evidence.covariance = Covariance();
  result.agreeing = fit_.pose.inliers;
  if (!has_motion_ && result.agreeing > 0) {
    // Blur by an unknown motion shows as patches that are not found. Its effect on the other
    // patches is a common error, so the covariance grows.
    result.evidence.covariance /= result.share() * result.share();
  }
  Judge(camera, result);
  if (result.honest) {
    EstimateShutter(image, camera, finest, pose);
    result.blur_px = BlurPx(camera, pose);
    Settle(camera, result);
  }
  return result;
}

void PatchTracker::Judge(const CameraModel& camera, FollowedPose& pose) {
  CHECK(fit_.observations.size() == fit_.pose.squares.size());
  std::array<bool, kSpreadColumns * kSpreadRows> covered{};
  int cells = 0;
  depths_.clear();
  for (size_t i = 0; i < fit_.observations.size(); ++i) {
    if (fit_.pose.squares[i] >= kInlierSquare) {
      continue;
    }
    const Eigen::Vector2d pixel = fit_.observations[i].pixel.cast<double>();
    bool& cell = covered[static_cast<size_t>(CellIn(camera, pixel, kSpreadColumns, kSpreadRows))];
    cells += cell ? 0 : 1;
    cell = true;
    depths_.push_back((pose.camera_from_map * fit_.matches[i].point).z());
  }
  if (depths_.empty()) {
    return;
  }
  std::sort(depths_.begin(), depths_.end());
  for (size_t i = 0; i < pose.evidence.depths.size(); ++i) {
    pose.evidence.depths[i] = depths_[(2 * i + 1) * depths_.size() / 6];
  }
  pose.evidence.inliers = pose.agreeing;
  const double variance = ComputeRegistrationVariance(camera, pose.evidence).Sum();
  pose.expected_error_px = std::sqrt(variance);
  pose.honest = pose.agreeing >= kLeastAgreeing && pose.share() >= kLeastShare &&
                cells >= kLeastCells && pose.expected_error_px < kLargestTrackedErrorPx;
}

// Updates the motion statistics, records which patches agreed, drops those that failed too often,
// and adds new ones.
void PatchTracker::Settle(const CameraModel& camera, const FollowedPose& pose) {
  SetMotion(pose.camera_from_map);
  if (has_motion_) {
    accelerations_ = Accelerations();
    knows_accelerations_ = true;
  }
  if (has_motion_ && has_motion_before_) {
    constexpr double kMemory = 0.7;
    const Vector6d acceleration = motion_ - motion_before_;
    accelerations_ =
        kMemory * accelerations_ + (1.0 - kMemory) * acceleration * acceleration.transpose();
  }
  has_motion_before_ = has_motion_;
  motion_before_ = motion_;
  seen_.clear();
  for (Slot& slot : slots_) {
    ++slot.failures;
  }
  for (size_t i = 0; i < fit_.observations.size(); ++i) {
    if (fit_.pose.squares[i] < kInlierSquare) {
      Slot& slot = slots_[fit_.observations[i].slot];
      slot.failures = 0;
      seen_.push_back({slot.point, fit_.observations[i].pixel});
    }
  }
  SettleHidden(camera, pose.camera_from_map);
  for (size_t i = slots_.size(); i-- > 0;) {
    Slot& slot = slots_[i];
    const auto pixel = camera.Project(pose.camera_from_map * slot.point_in_map);
    if (!pixel || !camera.Contains(*pixel)) {
      RemoveSlot(i, 0);
    } else if (slot.failures >= kMostFailures) {
      RemoveSlot(i, kRestFailed);
    } else if ((slot.point + now_) % kAimInterval == 0 && !AimSlot(slot, pose.camera_from_map)) {
      RemoveSlot(i, kRestFailed);
    }
  }
  CountCells(camera, pose.camera_from_map);
  if (next_near_ >= near_count_) {
    RankKeyframes(pose.camera_from_map);
    next_near_ = 0;
  }
  if (near_count_ > 0 && slots_.size() < kMostSlots) {
    AddFrom(near_[next_near_++], camera, pose.camera_from_map,
            slots_.size() < kMostSlots / 2 ? 2 : 1);
  }
}

}  // namespace lararium::vision
