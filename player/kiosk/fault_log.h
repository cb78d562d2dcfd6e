#pragma once

// Logs problems with camera and tracking: one line when a problem begins and one when it ends,
// however long it lasts.

#include <optional>
#include <string>

#include "shared/core/log.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::player {

class FaultLog {
 public:
  // Seconds without a pose before it is logged. Visitors who look away for a moment are not logged.
  static constexpr double kTellAfter = 1.0;

  // Borrows log.
  explicit FaultLog(Log& log) : log_(log) {}

  // Callbacks for capture::SteadyCameraWorld. They may be called from any thread.
  void CameraChanged(bool connected, const std::string& why);
  void ClockChanged(bool steady, double leap);

  // Call this after each frame, in order.
  void AfterFrame(const vision::TrackedFrame& tracked);

 private:
  Log& log_;
  std::optional<double> lost_since_;  // capture time, seconds; nullopt: the last frame had a pose
  bool told_ = false;                 // this loss was logged
};

}  // namespace lararium::player
