#pragma once

// Smooths the tracker's poses, so that people on the stage neither jump nor tremble.
//
// Correction. While the camera is tracked from frame to frame, its pose may drift a little. When
// the tracker relocalises, the new pose is right, but everything on the stage would jump. The
// difference between the extrapolated shown motion and the new pose is therefore removed smoothly
// over a fixed time. If it moves the picture by more than a bound, it is dropped at once, because
// a jump is better than people in the wrong place.
//
// Filter. A low-pass on the pose whose cutoff rises with the speed, after the One Euro filter
// (Casiez, Roussel & Vogel, "1 Euro filter", CHI 2012): strong while the camera stands still, weak
// while it moves. The speed is measured in standard deviations of the pose, from its covariance, so
// that noise counts equally in every direction. The filter adds a lag of 1 / (2 pi cutoff) seconds
// and keeps the pose within a few standard deviations of the tracker's pose.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/geometry/transform.h"
#include "shared/vision/pose_refinement.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::vision {

enum class Smoothing {
  kOff,     // Poses pass unchanged.
  kSoft,    // Correction only; adds no lag.
  kStrong,  // Correction and filter.
};

struct PoseSmootherOptions {
  bool correct = true;
  double correction_seconds = 0.25;  // Time over which a correction fades out.
  double correction_px = 4.0;        // Corrections that move the picture farther are dropped.

  bool filter = false;
  double still_cutoff_hz = 1.0;    // Cutoff while the camera stands still.
  double cutoff_per_speed = 0.02;  // Hz per standard deviation per second.
  double speed_cutoff_hz = 1.0;    // Cutoff of the low-pass on the velocity.
  double most_deviations = 3.0;    // Maximum distance of the filtered pose from the tracker's pose.

  static PoseSmootherOptions Of(Smoothing smoothing);
};

// The motion (w, v) that takes one pose (R, t) to another: (exp(w) R, exp(w) t + v).
using Twist = Eigen::Matrix<double, 6, 1>;
Twist TwistBetween(const geometry::Rigid3& from, const geometry::Rigid3& to);

// The largest distance, in pixels, by which a landmark moves in the image between two poses.
// Counts the landmarks in view of the first pose; nullopt if there are none.
std::optional<double> PictureShift(const geometry::CameraModel& camera,
                                   std::span<const Eigen::Vector3d> landmarks,
                                   const geometry::Rigid3& from,
                                   const geometry::Rigid3& to);

class PoseSmoother {
 public:
  // landmarks: for each map, a sample of its points.
  PoseSmoother(const PoseSmootherOptions& options,
               std::vector<std::vector<Eigen::Vector3d>> landmarks);

  // Replaces the pose of the next frame. Restarts at a frame without a pose, at a change of the
  // map, and if time does not advance or has a gap.
  void Apply(TrackedFrame& tracked);

 private:
  struct Shown {
    geometry::Rigid3 camera_from_map;
    double time = 0.0;
    bool followed = false;
  };
  struct Correction {
    Twist offset = Twist::Zero();  // Motion from the tracker's to the shown pose at `start`.
    double start = 0.0;
  };

  void Filter(const TrackedFrame& tracked, double interval, geometry::Rigid3& pose);
  void Correct(const TrackedFrame& tracked, double interval, geometry::Rigid3& pose);
  void Restart();

  PoseSmootherOptions options_;
  std::vector<std::vector<Eigen::Vector3d>> landmarks_;
  uint32_t map_ = 0;
  std::optional<Shown> shown_;  // Pose shown in the frame before.
  Twist shown_velocity_ = Twist::Zero();
  std::optional<Correction> correction_;
  std::optional<geometry::Rigid3> measured_;  // The tracker's pose in the frame before.
  std::optional<geometry::Rigid3> filtered_;
  Twist velocity_ = Twist::Zero();  // Low-passed velocity per second.
};

// Wraps a pose source in a smoother. Returns the source itself if smoothing is off. maps are the
// maps of the source.
std::unique_ptr<PoseSource> Smooth(std::unique_ptr<PoseSource> poses,
                                   std::span<const std::shared_ptr<const SceneDatabase>> maps,
                                   Smoothing smoothing);

}  // namespace lararium::vision
