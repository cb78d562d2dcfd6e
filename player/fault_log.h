#pragma once

// Says in the log what happens to the images that a show lives on: one line when it begins and one
// when it is over, however long it lasts.

#include <optional>
#include <string>

#include "shared/core/log.h"
#include "shared/vision/tracked_frame.h"

namespace lararium::player {

class FaultLog {
 public:
  // Seconds without a pose after which the log is told: who looks away for a moment is not news.
  static constexpr double kTellAfter = 1.0;

  // Borrows log.
  explicit FaultLog(Log& log) : log_(log) {}

  // As capture::SteadyCameraWorld tells of them. From any thread.
  void CameraChanged(bool connected, const std::string& why);
  void ClockChanged(bool steady, double leap);

  // After each frame, in order.
  void AfterFrame(const vision::TrackedFrame& tracked);

 private:
  Log& log_;
  std::optional<double> lost_since_;  // capture time; none: the last frame had a pose
  bool told_ = false;                 // of this loss
};

}  // namespace lararium::player
