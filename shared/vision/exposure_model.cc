#include "shared/vision/exposure_model.h"

#include <algorithm>

namespace lararium::vision {
namespace {

geometry::Rigid3 ExpMotion(const Vector6d& motion) {
  return {geometry::RotationFromVector(motion.head<3>()), motion.tail<3>()};
}

}  // namespace

void ExposureModel::BeginImage(const geometry::Rigid3* before, double frames) {
  known_ = before != nullptr;
  if (before != nullptr) {
    before_ = *before;
    frames_ = frames;
  }
}

void ExposureModel::SetPose(const geometry::Rigid3& camera_from_map) {
  if (!known_) {
    return;
  }
  const geometry::Rigid3 since = camera_from_map * before_.Inverse();
  motion_.head<3>() = geometry::VectorFromRotation(since.rotation) / frames_;
  motion_.tail<3>() = since.translation / frames_;
  const Vector6d acceleration =
      motion_before_ ? Vector6d(motion_ - *motion_before_) : Vector6d::Zero();
  // motion_ is the velocity half a frame ago. The rotation is extrapolated to the time of this
  // image. The translation is the mean of the last two, because poses err by more than it changes:
  // a focal length that is too long goes with a camera that is too far away, and so with a wrong
  // speed along the axis, which the rows of a rolling shutter would turn into a focal length that
  // is too short.
  exposure_.during_frame = motion_;
  exposure_.during_frame.head<3>() += 0.5 * acceleration.head<3>();
  exposure_.during_frame.tail<3>() -= 0.5 * acceleration.tail<3>();
  exposure_.velocity = ExpMotion(exposure_.during_frame);
  exposure_.acceleration = ExpMotion(acceleration);
}

void ExposureModel::EndImage(const geometry::Rigid3& camera_from_map) {
  SetPose(camera_from_map);
  if (!known_) {
    motion_before_.reset();
    return;
  }
  accelerations_ = Accelerations();
  if (motion_before_) {
    constexpr double kMemory = 0.7;
    const Vector6d acceleration = motion_ - *motion_before_;
    *accelerations_ =
        kMemory * *accelerations_ + (1.0 - kMemory) * acceleration * acceleration.transpose();
  }
  motion_before_ = motion_;
}

void ExposureModel::Forget() {
  known_ = false;
  motion_before_.reset();
}

// Moves towards the maximum of the parabola through the three correlations.
void ExposureModel::LearnShutter(double less, double same, double more) {
  constexpr double kLeastShare = 0.25;  // Share of the step that is applied after many trials.
  const double bend = 2.0 * same - less - more;
  const double rise = more - less;
  const double step =
      bend > 0.0 ? std::clamp(0.5 * rise / bend, -1.0, 1.0) : (rise > 0.0 ? 1.0 : -1.0);
  const double share = std::max(kLeastShare, 1.0 / ++shutter_trials_);
  exposure_.shutter =
      std::clamp(exposure_.shutter + share * kShutterStep * step, kShutterStep, 1.0);
}

std::optional<float> ExposureModel::shutter() const {
  constexpr int kEnoughTrials = 3;
  return shutter_trials_ < kEnoughTrials ? std::nullopt
                                         : std::optional(static_cast<float>(exposure_.shutter));
}

// Mean square of the recent acceleration. Before any was measured, the motion may have just begun,
// so the acceleration may be as large as the motion.
Matrix6d ExposureModel::Accelerations() const {
  return accelerations_ ? *accelerations_ : Matrix6d(motion_ * motion_.transpose());
}

Matrix6d ExposureModel::UnpredictedCovariance() const {
  // Displacement by an unpredicted acceleration a, as a share of shutter^2 a.
  constexpr double kUnforeseen = 1.0 / 16.0;
  const double share = kUnforeseen * exposure_.shutter * exposure_.shutter;
  const Matrix6d accelerations = Accelerations();
  Matrix6d doubt = accelerations;
  doubt.diagonal().head<3>().array() += accelerations.diagonal().head<3>().mean();
  doubt.diagonal().tail<3>().array() += accelerations.diagonal().tail<3>().mean();
  return share * share * doubt;
}

Eigen::Matrix3d ExposureModel::UnpredictedTurning() const {
  // The motion is extrapolated by half a frame time.
  constexpr double kUnforeseen = 0.5;
  constexpr double kLeast = 0.001;  // radians per frame time
  const Eigen::Matrix3d accelerations = kUnforeseen * Accelerations().topLeftCorner<3, 3>();
  Eigen::Matrix3d doubt = accelerations;
  doubt.diagonal().array() += accelerations.diagonal().mean() + kLeast * kLeast;
  return doubt;
}

}  // namespace lararium::vision
