#include "shared/show/tracking_loss_fader.h"

#include <algorithm>
#include <cmath>

#include "shared/vision/pose_smoother.h"

namespace lararium::show {
namespace {

using geometry::Rigid3;

constexpr double kLongestStep = 1.0;  // Seconds; a longer step restarts the fader.
// Time constant with which the motion before a loss decays.
constexpr double kMotionSeconds = 0.25;
// Longest interval between two poses that give a velocity.
constexpr double kLongestInterval = 0.2;
constexpr double kCorrectionSeconds = 0.25;
constexpr double kLeaveSeconds = 0.12;  // Fade-out when the pose returns elsewhere.
constexpr double kUnseenShiftPx = 1.5;  // A jump of this size is invisible.
constexpr double kFadedDistance = 3.0;  // metres

// Remaining part of a correction after a share of its time.
double Remaining(double share) {
  const double x = std::clamp(share, 0.0, 1.0);
  return 1.0 - x * x * (3.0 - 2.0 * x);
}

float Towards(float value, float goal, double step, double seconds) {
  const auto most = static_cast<float>(step / std::max(seconds, 1e-3));
  return value < goal ? std::min(value + most, goal) : std::max(value - most, goal);
}

}  // namespace

Status TrackingLossFaderOptions::Validate() const {
  for (const double seconds : {hold, fade, appear, guide_after, guide_fade}) {
    if (!(seconds >= 0.0 && seconds <= 60.0)) {
      return Status::Error("tracking loss", "all times must be 0 to 60 seconds");
    }
  }
  return most_shift_px >= 0.0
             ? Status()
             : Status::Error("tracking loss", "the largest shift must not be negative");
}

double PictureShiftOf(const geometry::CameraModel& display,
                      const Rigid3& before_from_stage,
                      const Rigid3& after_from_stage) {
  const Rigid3 after_from_before = after_from_stage * before_from_stage.Inverse();
  double most = 0.0;
  for (const double x : {0.1, 0.5, 0.9}) {
    for (const double y : {0.1, 0.5, 0.9}) {
      const Eigen::Vector2d pixel(x * display.width, y * display.height);
      const Eigen::Vector2d plane = display.PlaneFromPixel(pixel);
      const Eigen::Vector3d point(kFadedDistance * plane.x(), kFadedDistance * plane.y(),
                                  kFadedDistance);
      const auto moved = display.Project(after_from_before * point);
      most = std::max(most, moved ? (*moved - pixel).norm()
                                  : static_cast<double>(display.width + display.height));
    }
  }
  return most;
}

void TrackingLossFader::Reset() {
  const bool glides = glides_;
  *this = TrackingLossFader(options_);
  glides_ = glides;
}

// Without a past, takes the frame's state at once: a seek must not fade.
void TrackingLossFader::Begin(double time, const std::optional<Rigid3>& pose, uint32_t place) {
  const bool first = !time_;
  Reset();
  time_ = time;
  if (pose) {
    shown_ = last_pose_ = pose;
    last_pose_time_ = found_time_ = time;
    place_ = place;
    seen_ = true;
    opacity_ = first ? 0.0f : 1.0f;
  } else {
    lost_since_ = time;
  }
}

Rigid3 TrackingLossFader::Continued(double time) const {
  const double since = std::max(time - last_pose_time_, 0.0);
  const double moving = kMotionSeconds * (1.0 - std::exp(-since / kMotionSeconds));
  // The remaining correction at the time of the loss stays.
  const double share = (last_pose_time_ - found_time_) / kCorrectionSeconds;
  return vision::Moved(*last_pose_, velocity_ * moving + Remaining(share) * offset_);
}

void TrackingLossFader::Track(double step,
                              double time,
                              const Rigid3& pose,
                              uint32_t place,
                              const geometry::CameraModel& display) {
  const bool found = lost_since_.has_value();
  if (found && shown_ && opacity_ > 0.0f) {
    const Rigid3 continued = leaving_ ? *shown_ : Continued(time);
    leaving_ = place != place_ || IsElsewhere(pose, continued, display);
    offset_ = leaving_ || !glides_ ? Twist::Zero().eval() : vision::TwistBetween(pose, continued);
    found_time_ = time;
  } else if (found || !shown_) {
    offset_.setZero();
    found_time_ = time;
    leaving_ = false;
    shown_.reset();
  }
  const bool was_leaving = leaving_;
  if (leaving_) {
    opacity_ = Towards(opacity_, 0.0f, step, kLeaveSeconds);
    leaving_ = opacity_ > 0.0f;
  }
  const double interval = time - last_pose_time_;
  velocity_ = last_pose_ && !found && interval > 0.0 && interval <= kLongestInterval
                  ? (vision::TwistBetween(*last_pose_, pose) / interval).eval()
                  : Twist::Zero().eval();
  last_pose_ = pose;
  last_pose_time_ = time;
  if (!leaving_) {
    const double share = (time - found_time_) / kCorrectionSeconds;
    shown_ = vision::Moved(pose, Remaining(share) * offset_);
    place_ = place;
    // People who have just faded out appear at the new pose only in the next picture.
    opacity_ = was_leaving ? 0.0f : Towards(opacity_, 1.0f, step, options_.appear);
  }
  lost_since_.reset();
  seen_ = true;
}

void TrackingLossFader::Lose(double step, double time, bool dark) {
  lost_since_ = lost_since_.value_or(time);
  if (!shown_) {
    return;
  }
  if (!leaving_) {
    shown_ = Continued(time);
  }
  if (dark) {
    opacity_ = 0.0f;
  } else if (leaving_ || time - *lost_since_ >= options_.hold) {
    opacity_ = Towards(opacity_, 0.0f, step, leaving_ ? kLeaveSeconds : options_.fade);
  }
  if (opacity_ <= 0.0f) {
    shown_.reset();
    leaving_ = false;
  }
}

// Whether the pose is too far from the shown one to be corrected gradually. A correction is
// invisible while the whole picture moves by as much.
bool TrackingLossFader::IsElsewhere(const Rigid3& pose,
                                    const Rigid3& continued,
                                    const geometry::CameraModel& display) const {
  const double moved = PictureShiftOf(display, *last_pose_, pose);
  const double most = std::clamp(0.5 * moved, options_.most_shift_px, 4.0 * options_.most_shift_px);
  return PictureShiftOf(display, pose, continued) > (glides_ ? most : kUnseenShiftPx);
}

TrackingLossFader::View TrackingLossFader::MakeView(double time) const {
  View view;
  view.place = place_;
  view.opacity = opacity_;
  view.guide = guide_;
  view.lost_seconds = lost_since_ ? time - *lost_since_ : 0.0;
  if (shown_ && opacity_ > 0.0f) {
    view.camera_from_stage = shown_;
  }
  if (!lost_since_) {
    view.state = State::kShown;
  } else if (!seen_) {
    view.state = State::kSearching;
  } else if (!shown_) {
    view.state = State::kGone;
  } else {
    view.state = opacity_ < 1.0f ? State::kFading : State::kHeld;
  }
  return view;
}

TrackingLossFader::View TrackingLossFader::Update(double time,
                                                  const std::optional<Rigid3>& camera_from_stage,
                                                  uint32_t place,
                                                  const geometry::CameraModel& display,
                                                  bool dark) {
  const double step = time_ ? time - *time_ : 0.0;
  if (!time_ || step < 0.0 || step > kLongestStep) {
    Begin(time, camera_from_stage, place);
    return MakeView(time);
  }
  time_ = time;
  if (camera_from_stage) {
    Track(step, time, *camera_from_stage, place, display);
  } else {
    Lose(step, time, dark);
  }
  const bool guides = lost_since_ && time - *lost_since_ >= options_.guide_after;
  guide_ = Towards(guide_, guides ? 1.0f : 0.0f, step, options_.guide_fade * (guides ? 1.0 : 0.5));
  return MakeView(time);
}

}  // namespace lararium::show
