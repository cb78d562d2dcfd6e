#include "shared/vision/motion_model.h"

#include <algorithm>
#include <cmath>

namespace lararium::vision {

using geometry::Rigid3;

double FrameClock::Time(const geometry::Frame& frame) {
  const auto frames = static_cast<double>(frame.index - last_index_.value_or(frame.index));
  const double seconds = frame.capture_time - last_capture_;
  if (frames > 0.0) {
    now_ += seconds > 0.0 ? Step(seconds, frames) : frames;
  }
  last_index_ = frame.index;
  last_capture_ = frame.capture_time;
  return now_;
}

double FrameClock::Step(double seconds, double frames) {
  if (known_ < kIntervals) {
    // Gaps are only ever longer than a frame time, so the lower quartile tells it.
    intervals_[known_++] = seconds / frames;
    std::array<double, kIntervals> sorted = intervals_;
    const auto quartile = sorted.begin() + static_cast<ptrdiff_t>((known_ - 1) / 4);
    std::nth_element(sorted.begin(), quartile, sorted.begin() + static_cast<ptrdiff_t>(known_));
    frame_time_ = *quartile;
  }
  const double step = seconds / frame_time_;
  // Containers round times, and drivers delay them.
  constexpr double kJitter = 0.1;  // Frame times.
  const double whole = std::round(step);
  return whole >= 1.0 && std::abs(step - whole) < kJitter ? whole : step;
}

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
