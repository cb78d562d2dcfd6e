#include "shared/audio/sound_clock.h"

#include <cmath>

namespace lararium::audio {
namespace {

// Clock difference beyond which the drama has jumped, and share of a smaller one that is corrected
// in each block.
constexpr double kJumpSeconds = 0.25;
constexpr double kEvenOut = 0.02;

}  // namespace

double SoundClock::Next(double scene_time,
                        std::chrono::steady_clock::time_point shown,
                        std::chrono::steady_clock::time_point heard,
                        double block_seconds) {
  const double wanted = scene_time + std::chrono::duration<double>(heard - shown).count();
  if (!next_ || std::abs(wanted - *next_) > kJumpSeconds) {
    next_ = wanted;
  }
  const double now = *next_ + kEvenOut * (wanted - *next_);
  next_ = now + block_seconds;
  return now;
}

}  // namespace lararium::audio
