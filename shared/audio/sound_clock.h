#pragma once

#include <chrono>
#include <optional>

namespace lararium::audio {

// Computes the drama's time of the samples to mix now from the times at which scenes were shown.
// Small differences (clock drift, uneven frames) are corrected gradually; large ones are seeks.
class SoundClock {
 public:
  // Returns the drama's time of samples that will be heard at `heard`. shown: when the scene of
  // scene_time was seen.
  double Next(double scene_time,
              std::chrono::steady_clock::time_point shown,
              std::chrono::steady_clock::time_point heard,
              double block_seconds);

 private:
  std::optional<double> next_;
};

}  // namespace lararium::audio
