#pragma once

// Estimates how the camera moves while an image is exposed. The patches are blurred accordingly.

#include <optional>

#include "shared/geometry/transform.h"
#include "shared/vision/pose_refinement.h"

namespace lararium::vision {

// The motion of the camera during the exposure of one image.
struct ExposureMotion {
  // Displacements of the camera frame (now_from_before) during one frame time, by its velocity and
  // by its acceleration.
  geometry::Rigid3 velocity;
  geometry::Rigid3 acceleration;
  Vector6d during_frame = Vector6d::Zero();  // The velocity as (w, v).
  double shutter = 0.3;  // Share of the frame time for which the shutter is open.
};

class ExposureModel {
 public:
  // Step between the shutter times that LearnShutter() compares.
  static constexpr double kShutterStep = 0.15;

  // Begins an image. before is the pose of the previous image, `frames` frames ago, or nullptr if
  // it is unknown.
  void BeginImage(const geometry::Rigid3* before, double frames);
  // Derives the motion from a pose of this image.
  void SetPose(const geometry::Rigid3& camera_from_map);
  // Adds the final pose of this image to the statistics of the motion.
  void EndImage(const geometry::Rigid3& camera_from_map);
  // Forgets the motion, because the pose was found without a prior.
  void Forget();

  // nullptr if the motion in this image is unknown. Stays valid as long as the model.
  const ExposureMotion* motion() const { return known_ ? &exposure_ : nullptr; }

  // Learns the shutter time from the correlations of the patches if they are blurred for a time
  // that is kShutterStep shorter, for the present time, and for a time that is kShutterStep longer.
  void LearnShutter(double less, double same, double more);
  // See TrackedFrame::shutter.
  std::optional<float> shutter() const;

  // Covariance of the displacement, as in PatchPose::covariance, by the part of the acceleration
  // during the exposure that earlier images do not predict. Requires motion().
  Matrix6d UnpredictedCovariance() const;
  // Covariance of the first part of ExposureMotion::during_frame, the turning, by what earlier
  // images do not predict. Requires motion().
  Eigen::Matrix3d UnpredictedTurning() const;

 private:
  Matrix6d Accelerations() const;

  ExposureMotion exposure_;
  bool known_ = false;
  geometry::Rigid3 before_;
  double frames_ = 1.0;
  // Camera motions (w, v) per frame: from the image before to this one, and the motion before that.
  Vector6d motion_ = Vector6d::Zero();
  std::optional<Vector6d> motion_before_;
  std::optional<Matrix6d> accelerations_;  // Running mean square of the acceleration.
  int shutter_trials_ = 0;
};

}  // namespace lararium::vision
