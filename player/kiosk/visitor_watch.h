#pragma once

// Detects whether a visitor is present: a headset that lies on its stand does not move. When the
// next visitor takes it, the show restarts.

#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::player {

struct VisitorWatchOptions {
  double idle_seconds = 45.0;  // a visitor has left after this time without motion or pose
  double still_metres = 0.01;  // largest motion of a headset at rest
  double still_radians = 0.01;
  double moving_seconds = 0.4;  // motion for this time means that a visitor has come
};

class VisitorWatch {
 public:
  enum class Event { kNone, kLeft, kCame };

  explicit VisitorWatch(const VisitorWatchOptions& options = {}) : options_(options) {}

  // Call this for each frame with its time (seconds) and its pose, if it has one.
  Event Update(double time, const std::optional<geometry::Rigid3>& camera_from_stage);

  // Call this when a button was pressed, which means that a visitor is present.
  Event Touch(double time);

  // Ends the presence of the visitor: motion from now on is that of the next one.
  void Leave();

  bool present() const { return present_; }
  // True if a visitor was noticed and has not left since. (At the beginning present() is true,
  // although no visitor has been noticed yet.)
  bool noticed() const { return present_ && noticed_; }
  // Time of the visitor's last motion or button, seconds. Valid while noticed().
  double last_sign() const { return last_sign_.value_or(0.0); }

 private:
  Event Arrive(double time);

  VisitorWatchOptions options_;
  bool present_ = true;
  bool noticed_ = false;
  std::optional<geometry::Rigid3> rest_;  // pose after the last motion
  std::optional<double> last_sign_;       // time of the last sign of a visitor
  std::optional<double> moving_since_;
  double last_motion_ = 0.0;
};

}  // namespace lararium::player
