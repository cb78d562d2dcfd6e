#pragma once

// What may stand between the tracker and the show, so that people on the stage
// neither jump nor tremble.
//
// Correction. While the tracker follows, its pose may stray by a little; the pose
// that it then finds anew is right, and everything on the stage would jump. The
// difference between the shown motion, continued, and the new pose is taken back
// smoothly over a fixed time instead. Where it moves the picture by more than a
// bound it is dropped at once: rather a jump than people in the wrong place.
//
// Filter. A low-pass on the pose whose cutoff rises with the speed, after the One
// Euro filter (Casiez, Roussel & Vogel, "1 Euro filter", CHI 2012): strong where the
// camera stands, hardly there where it moves. The speed is measured in standard
// deviations of the pose, by its covariance, so that noise looks like noise in
// every direction. It adds a lag of 1 / (2 pi cutoff) seconds, and never holds the
// pose further from the tracker's than a few standard deviations.

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
  kOff,     // poses pass as they are
  kSoft,    // the correction only: adds no lag
  kStrong,  // the correction and the filter
};

struct PoseSmootherOptions {
  bool correct = true;
  double correction_seconds = 0.25;  // in which a correction is taken back
  double correction_px = 4.0;        // of the picture; larger ones are dropped at once

  bool filter = false;
  double still_cutoff_hz = 1.0;    // where the camera stands
  double cutoff_per_speed = 0.02;  // Hz for each standard deviation per second
  double speed_cutoff_hz = 1.0;    // of the low-pass on the velocity
  double most_deviations = 3.0;    // between the filtered pose and the tracker's

  static PoseSmootherOptions Of(Smoothing smoothing);
};

// The motion b_from_a = (exp(w), v) that takes one pose to another:
// target = (exp(w) R, exp(w) t + v), as (w, v).
using Twist = Eigen::Matrix<double, 6, 1>;
Twist TwistBetween(const geometry::Rigid3& from, const geometry::Rigid3& to);

// The most that the picture of the landmarks moves between two poses, in pixels,
// over those that the first one sees; nullopt where it sees none.
std::optional<double> PictureShift(const geometry::CameraModel& camera,
                                   std::span<const Eigen::Vector3d> landmarks,
                                   const geometry::Rigid3& from,
                                   const geometry::Rigid3& to);

class PoseSmoother {
 public:
  // landmarks: for each map, points that stand for what is seen there.
  PoseSmoother(const PoseSmootherOptions& options,
               std::vector<std::vector<Eigen::Vector3d>> landmarks);

  // Replaces the pose of the next frame. A frame without a pose, another map, or
  // time that does not advance start afresh.
  void Apply(TrackedFrame& tracked);

 private:
  struct Shown {
    geometry::Rigid3 camera_from_map;
    double time = 0.0;
    bool followed = false;
  };
  struct Correction {
    Twist offset = Twist::Zero();  // from the tracker's pose to the shown one, at its start
    double start = 0.0;
  };

  void Filter(const TrackedFrame& tracked, double interval, geometry::Rigid3& pose);
  void Correct(const TrackedFrame& tracked, double interval, geometry::Rigid3& pose);
  void Restart();

  PoseSmootherOptions options_;
  std::vector<std::vector<Eigen::Vector3d>> landmarks_;
  uint32_t map_ = 0;
  std::optional<Shown> shown_;  // in the frame before
  Twist shown_velocity_ = Twist::Zero();
  std::optional<Correction> correction_;
  std::optional<geometry::Rigid3> measured_;  // the tracker's pose in the frame before
  std::optional<geometry::Rigid3> filtered_;
  Twist velocity_ = Twist::Zero();  // low-passed, per second
};

// A pose source with a smoother behind it; the source itself where smoothing is
// off. maps: of the source.
std::unique_ptr<PoseSource> Smooth(std::unique_ptr<PoseSource> poses,
                                   std::span<const std::shared_ptr<const SceneDatabase>> maps,
                                   Smoothing smoothing);

}  // namespace lararium::vision
