#include "player/kiosk/visitor_watch.h"

namespace lararium::player {
namespace {

constexpr double kMotionGap = 0.5;  // seconds without motion end a motion

}  // namespace

VisitorWatch::Event VisitorWatch::Arrive(double time) {
  last_sign_ = time;
  noticed_ = true;
  if (present_) {
    return Event::kNone;
  }
  present_ = true;
  return Event::kCame;
}

VisitorWatch::Event VisitorWatch::Touch(double time) { return Arrive(time); }

void VisitorWatch::Leave() {
  present_ = false;
  noticed_ = false;
  moving_since_.reset();
}

VisitorWatch::Event VisitorWatch::Update(double time,
                                         const std::optional<geometry::Rigid3>& camera_from_stage) {
  last_sign_ = last_sign_.value_or(time);
  bool moved = false;
  if (camera_from_stage) {
    moved = rest_ &&
            ((camera_from_stage->Center() - rest_->Center()).norm() > options_.still_metres ||
             camera_from_stage->rotation.angularDistance(rest_->rotation) > options_.still_radians);
    if (!rest_ || moved) {
      rest_ = camera_from_stage;
    }
  }
  if (moved) {
    if (!moving_since_ || time - last_motion_ > kMotionGap) {
      moving_since_ = time;
    }
    last_motion_ = time;
    if (time - *moving_since_ >= options_.moving_seconds) {
      return Arrive(time);
    }
  }
  if (present_ && time - *last_sign_ >= options_.idle_seconds) {
    Leave();
    return Event::kLeft;
  }
  return Event::kNone;
}

}  // namespace lararium::player
