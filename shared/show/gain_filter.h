#pragma once

// Steadies the camera gain of successive frames, so that noise in the estimate
// does not make people flicker, and does not lag behind a camera that hunts for its exposure.

#include <array>
#include <optional>

namespace lararium::show {

// The straight line through log(gain) over time, channel by channel, by least squares whose
// weights fade by exp(-age / kMemory), read at its newest end: the critically damped g-h
// filter (Brookner, "Tracking and Kalman Filtering Made Easy", 1998, section 1.2.6). A gain
// that changes at an even rate is followed without lag; what is left of a step decays within
// some kMemory, with a tenth of it beyond. Each gain is measured by itself against the map, so
// that nothing adds up.
class GainFilter {
 public:
  static constexpr double kMemory = 0.06;  // seconds
  // Larger differences are no noise and no drift: taken at once. Of natural logarithms.
  static constexpr double kJump = 0.35;

  // gain: linear R, G, B, positive; time: of the frame, seconds. Time that goes back
  // begins anew, the same time changes nothing.
  std::array<float, 3> Update(const std::array<float, 3>& gain, double time);

  // The next gain is taken as it is: after a gap without poses, or at another place.
  void Reset() { time_.reset(); }

 private:
  struct Line {
    double at = 0.0;    // the newest time
    double rate = 0.0;  // for each second
  };
  std::optional<double> time_;
  std::array<Line, 3> log_gain_ = {};
};

}  // namespace lararium::show
