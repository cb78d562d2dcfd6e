#pragma once

// Smooths the camera gain of successive frames, so that noise in the estimate does not make people
// flicker, without lag when the camera adapts its exposure.

#include <array>
#include <optional>

namespace lararium::show {

// Fits a line to log(gain) over time, for each channel, by least squares with weights exp(-age /
// kMemory), and evaluates it at the newest time: the critically damped g-h filter (Brookner,
// "Tracking and Kalman Filtering Made Easy", 1998, section 1.2.6). It follows a constant rate
// without lag; the error after a step decays within a few kMemory, with an overshoot of a tenth.
// Each gain is measured against the map, so errors do not accumulate.
class GainFilter {
 public:
  static constexpr double kMemory = 0.06;  // seconds
  // Larger differences in log gain are neither noise nor drift and are taken at once.
  static constexpr double kJump = 0.35;

  // gain: linear R, G, B, positive. time: of the frame, seconds. A step back restarts the filter;
  // an equal time does not change it.
  std::array<float, 3> Update(const std::array<float, 3>& gain, double time);

  // Takes the next gain unfiltered. Call after a gap without poses, or at another place.
  void Reset() { time_.reset(); }

 private:
  struct Line {
    double at = 0.0;    // Value at the newest time.
    double rate = 0.0;  // Slope per second.
  };
  std::optional<double> time_;
  std::array<Line, 3> log_gain_ = {};
};

}  // namespace lararium::show
