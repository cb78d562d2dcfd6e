#pragma once

// Whether somebody watches: a headset that lies on its stand does not move. When the next visitor
// takes it up, the show begins anew for them.

#include <optional>

#include "shared/geometry/transform.h"

namespace lararium::player {

struct VisitorWatchOptions {
  double idle_seconds = 45.0;  // without motion or without a pose: nobody is there
  double still_metres = 0.01;  // what a headset at rest moves by at most
  double still_radians = 0.01;
  double moving_seconds = 0.4;  // of motion: somebody is there again
};

class VisitorWatch {
 public:
  enum class Event { kNone, kLeft, kCame };

  explicit VisitorWatch(const VisitorWatchOptions& options = {}) : options_(options) {}

  // The next frame: its time (seconds) and its pose, if it has one.
  Event Update(double time, const std::optional<geometry::Rigid3>& camera_from_stage);

  // A button was pressed: somebody is there.
  Event Touch(double time);

  // Whoever moves from now on is another one.
  void Leave();

  bool present() const { return present_; }
  // Whether somebody was noticed who has not left since: at the beginning somebody may be there,
  // and nobody knows.
  bool noticed() const { return present_ && noticed_; }
  // When they last moved or pressed a button, seconds; while noticed().
  double last_sign() const { return last_sign_.value_or(0.0); }

 private:
  Event Arrive(double time);

  VisitorWatchOptions options_;
  bool present_ = true;
  bool noticed_ = false;
  std::optional<geometry::Rigid3> rest_;  // where it was when it last moved
  std::optional<double> last_sign_;       // when somebody was last known to be there
  std::optional<double> moving_since_;
  double last_motion_ = 0.0;
};

}  // namespace lararium::player
