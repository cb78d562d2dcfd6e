#include "shared/vision/motion_model.h"

namespace lararium::vision {

using geometry::Rigid3;

void MotionModel::Add(double time, const Rigid3& camera_from_map) {
  turn_.setZero();
  shift_.setZero();
  if (last_ && time > last_->time) {
    const Rigid3 motion = camera_from_map * last_->camera_from_map.Inverse();
    const double share = 1.0 / (time - last_->time);
    turn_ = share * geometry::VectorFromRotation(motion.rotation);
    shift_ = share * motion.translation;
  }
  last_ = {time, camera_from_map};
}

void MotionModel::Correct(const Rigid3& camera_from_map) {
  last_->camera_from_map = camera_from_map;
}

void MotionModel::Forget() {
  last_.reset();
  turn_.setZero();
  shift_.setZero();
}

Rigid3 MotionModel::Motion(double frames) const {
  return {geometry::RotationFromVector(frames * turn_), frames * shift_};
}

}  // namespace lararium::vision
