#include "shared/vision/pose_smoother.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/vision/wrapped_poses.h"

namespace lararium::vision {
namespace {

using geometry::Rigid3;

constexpr double kLongestInterval = 0.5;  // Seconds between frames; a longer gap restarts.
constexpr size_t kLandmarks = 64;         // Approximate number of landmarks per map.

// The share of a correction that is left after the share x of its time. Falls smoothly from 1 to 0
// with zero slope at both ends.
double Remaining(double x) {
  const double y = std::clamp(x, 0.0, 1.0);
  return 1.0 - y * y * (3.0 - 2.0 * y);
}

// The share of the remaining distance that a low-pass covers in an interval. This is exact for a
// constant input, so that the result does not depend on the frame rate.
double Gain(double cutoff_hz, double interval) {
  return 1.0 - std::exp(-2.0 * M_PI * cutoff_hz * interval);
}

class SmoothedPoses final : public WrappedPoses {
 public:
  SmoothedPoses(std::unique_ptr<PoseSource> poses,
                const PoseSmootherOptions& options,
                std::vector<std::vector<Eigen::Vector3d>> landmarks)
      : WrappedPoses(std::move(poses)), smoother_(options, std::move(landmarks)) {}

 private:
  void Apply(TrackedFrame& tracked) override { smoother_.Apply(tracked); }

  PoseSmoother smoother_;
};

}  // namespace

PoseSmootherOptions PoseSmootherOptions::Of(Smoothing smoothing) {
  PoseSmootherOptions options;
  options.correct = smoothing != Smoothing::kOff;
  options.filter = smoothing == Smoothing::kStrong;
  return options;
}

Twist TwistBetween(const Rigid3& from, const Rigid3& to) {
  const Eigen::Quaterniond turn = to.rotation * from.rotation.conjugate();
  Twist twist;
  twist << geometry::VectorFromRotation(turn), to.translation - turn * from.translation;
  return twist;
}

std::optional<double> PictureShift(const geometry::CameraModel& camera,
                                   std::span<const Eigen::Vector3d> landmarks,
                                   const Rigid3& from,
                                   const Rigid3& to) {
  std::optional<double> most;
  for (const Eigen::Vector3d& landmark : landmarks) {
    const auto before = camera.Project(from * landmark);
    if (!before || !camera.Contains(*before)) {
      continue;
    }
    const auto after = camera.Project(to * landmark);
    const double shift =
        after ? (*after - *before).norm() : std::hypot(camera.width, camera.height);
    most = std::max(most.value_or(0.0), shift);
  }
  return most;
}

PoseSmoother::PoseSmoother(const PoseSmootherOptions& options,
                           std::vector<std::vector<Eigen::Vector3d>> landmarks)
    : options_(options), landmarks_(std::move(landmarks)) {}

void PoseSmoother::Restart() {
  shown_.reset();
  shown_velocity_.setZero();
  correction_.reset();
  measured_.reset();
  filtered_.reset();
  velocity_.setZero();
}

void PoseSmoother::Filter(const TrackedFrame& tracked, double interval, Rigid3& pose) {
  if (!filtered_ || !measured_) {
    filtered_ = pose;
    return;
  }
  const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> covariance(tracked.covariance);
  if (covariance.info() != Eigen::Success || !(covariance.vectorD().minCoeff() > 0.0)) {
    filtered_ = pose;  // The noise is unknown.
    return;
  }
  // Root mean square over the degrees of freedom.
  const auto deviations = [&](const Twist& twist) {
    return std::sqrt(std::max(0.0, twist.dot(covariance.solve(twist)) / 6.0));
  };
  const Twist velocity = TwistBetween(*measured_, pose) / interval;
  velocity_ += Gain(options_.speed_cutoff_hz, interval) * (velocity - velocity_);
  const double cutoff =
      options_.still_cutoff_hz + options_.cutoff_per_speed * deviations(velocity_);
  const Twist way = TwistBetween(*filtered_, pose);
  const double least = 1.0 - options_.most_deviations / std::max(deviations(way), 1e-9);
  filtered_ = Moved(*filtered_, std::max(Gain(cutoff, interval), least) * way);
  pose = *filtered_;
}

void PoseSmoother::Correct(const TrackedFrame& tracked, double interval, Rigid3& pose) {
  const double now = tracked.frame.capture_time;
  const bool found_anew = shown_ && shown_->followed && !tracked.followed;
  if (found_anew) {
    const Rigid3 continued = Moved(shown_->camera_from_map, shown_velocity_ * interval);
    correction_ = Correction{TwistBetween(pose, continued), now};
  }
  if (!correction_) {
    return;
  }
  const double share = (now - correction_->start) / options_.correction_seconds;
  const Rigid3 corrected = Moved(pose, Remaining(share) * correction_->offset);
  const auto shift = map_ < landmarks_.size()
                         ? PictureShift(tracked.camera, landmarks_[map_], pose, corrected)
                         : std::nullopt;
  if (share >= 1.0 || !shift || !(*shift <= options_.correction_px)) {
    correction_.reset();
  } else {
    pose = corrected;
  }
}

void PoseSmoother::Apply(TrackedFrame& tracked) {
  if (!tracked.camera_from_map) {
    Restart();
    return;
  }
  const double now = tracked.frame.capture_time;
  const double interval = shown_ ? now - shown_->time : 0.0;
  if (tracked.map != map_ || !(interval > 0.0 && interval <= kLongestInterval)) {
    Restart();
    map_ = tracked.map;
  }
  const Rigid3 measured = *tracked.camera_from_map;
  Rigid3 pose = measured;
  if (options_.filter) {
    Filter(tracked, interval, pose);
  }
  if (options_.correct) {
    Correct(tracked, interval, pose);
  }
  if (shown_) {
    shown_velocity_ = TwistBetween(shown_->camera_from_map, pose) / interval;
  }
  shown_ = Shown{pose, now, tracked.followed};
  measured_ = measured;
  tracked.camera_from_map = pose;
}

std::unique_ptr<PoseSource> Smooth(std::unique_ptr<PoseSource> poses,
                                   std::span<const std::shared_ptr<const SceneDatabase>> maps,
                                   Smoothing smoothing) {
  if (smoothing == Smoothing::kOff) {
    return poses;
  }
  std::vector<std::vector<Eigen::Vector3d>> landmarks;
  for (const auto& map : maps) {
    std::vector<Eigen::Vector3d>& chosen = landmarks.emplace_back();
    const size_t step = std::max<size_t>(1, map->points.size() / kLandmarks);
    for (size_t i = 0; i < map->points.size(); i += step) {
      chosen.push_back(map->points[i].cast<double>());
    }
  }
  return std::make_unique<SmoothedPoses>(std::move(poses), PoseSmootherOptions::Of(smoothing),
                                         std::move(landmarks));
}

}  // namespace lararium::vision
