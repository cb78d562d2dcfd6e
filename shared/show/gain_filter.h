#pragma once

// Steadies the camera gain of successive frames, so that noise in the estimate
// does not make people flicker.

#include <array>
#include <optional>

namespace lararium::show {

// A low-pass filter of first order on log(gain), with time constant kTimeConstant:
// t after a step, exp(-t / kTimeConstant) of it is left, however many frames came
// in between. People therefore lag behind a change of the camera's exposure by
// about the time constant.
class GainFilter {
 public:
  static constexpr double kTimeConstant = 0.15;  // seconds

  // gain: linear R, G, B, positive; time: of the frame, seconds. Time that goes back
  // begins anew, the same time changes nothing.
  std::array<float, 3> Update(const std::array<float, 3>& gain, double time);

  // The next gain is taken as it is: after a gap without poses, or at another place.
  void Reset() { time_.reset(); }

 private:
  std::optional<double> time_;
  std::array<double, 3> log_gain_ = {};
};

}  // namespace lararium::show
