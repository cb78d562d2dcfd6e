#pragma once

// How late what is shown is seen: the display flashes at random moments, the camera looks at it,
// and the delay at which both agree best is the time from a picture's drawing to its image's
// arrival: through display, light and camera.

#include <cstdint>
#include <optional>
#include <vector>

#include "shared/core/random.h"

namespace lararium::player {

struct FlashResult {
  double latency_ms = 0.0;
  double agreement = 0.0;  // correlation of what was seen with what was shown, up to 1
};

class FlashTest {
 public:
  explicit FlashTest(uint64_t seed = 1) : random_(seed) {}

  // Whether the display is to be white now; seconds, ascending.
  bool Show(double time);

  // The brightness of the image that arrived at this time.
  void See(double time, double brightness);

  // none: too little was seen, or what was seen does not follow what was shown (the camera does
  // not look at the display).
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
