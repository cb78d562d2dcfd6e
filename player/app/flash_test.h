#pragma once

// Measures the latency of display and camera together. The display flashes at random moments while
// the camera looks at it. The delay with the best correlation is the time from drawing a picture to
// the arrival of its image.

#include <cstdint>
#include <optional>
#include <vector>

#include "shared/core/random.h"

namespace lararium::player {

struct FlashResult {
  double latency_ms = 0.0;
  double agreement = 0.0;  // correlation of brightness seen and brightness shown, at most 1
};

class FlashTest {
 public:
  explicit FlashTest(uint64_t seed = 1) : random_(seed) {}

  // Returns whether the display must be white at a time; seconds, ascending.
  bool Show(double time);

  // Adds the brightness of an image that arrived at a time, seconds.
  void See(double time, double brightness);

  // nullopt: there are too few images, or they do not correlate with the display (the camera is not
  // pointed at it).
  std::optional<FlashResult> Result() const;

 private:
  struct Change {
    double time = 0.0;
    bool white = false;
  };
  struct Seen {
    double time = 0.0;
    double brightness = 0.0;
  };
  double ShownAt(double time) const;  // -1 or 1
  double AgreementAt(double delay, double mean) const;

  Random random_;
  std::vector<Change> changes_;
  double next_change_ = 0.0;
  std::vector<Seen> seen_;
};

}  // namespace lararium::player
