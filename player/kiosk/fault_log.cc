#include "player/kiosk/fault_log.h"

#include <string_view>

namespace lararium::player {
namespace {

using vision::TrackReason;

std::string_view Explained(TrackReason reason) {
  switch (reason) {
    case TrackReason::kTooFewFeatures:
      return "too few features: a covered lens, blur or a bare wall";
    case TrackReason::kTooFewMatches:
      return "too few matches: another place, or another light";
    case TrackReason::kAmbiguous:
      return "ambiguous: parts of the place look alike; something unique has to be in view";
    default:
      return vision::Name(reason);
  }
}

}  // namespace

void FaultLog::CameraChanged(bool connected, const std::string& why) {
  if (connected) {
    log_.Info("the camera is back");
  } else {
    log_.Warn("{}; waiting for it", why);
  }
}

void FaultLog::ClockChanged(bool steady, double leap) {
  if (steady) {
    log_.Info("the camera's clock is steady again");
  } else {
    log_.Warn("the camera's clock leapt by {:.1f} s; the computer's stands in", leap);
  }
}

void FaultLog::AfterFrame(const vision::TrackedFrame& tracked) {
  const double time = tracked.frame.capture_time;
  if (!tracked.camera_from_map) {
    lost_since_ = lost_since_.value_or(time);
    if (!told_ && time - *lost_since_ >= kTellAfter) {
      told_ = true;
      log_.Info("the place is not found: {}", Explained(tracked.reason));
    }
    return;
  }
  if (told_) {
    log_.Info("the place is found after {:.1f} s", time - *lost_since_);
  }
  lost_since_.reset();
  told_ = false;
}

}  // namespace lararium::player
