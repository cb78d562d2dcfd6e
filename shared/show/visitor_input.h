#pragma once

// Input of a visitor besides the pose. Any thread sets it; the show takes it once for each frame.

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "shared/drama/drama.h"

namespace lararium::show {

class VisitorInput {
 public:
  struct Values {
    std::string keys = {};  // Pressed since the last Take(); see drama::AddKey.
    float hour = -1.0f;     // Local hour of day; negative: unknown.
    bool describes = false;
    bool reduced_motion = false;
    bool holds = false;                  // The drama stands still.
    std::optional<double> restart = {};  // Time of the drama, seconds.
    bool forgets_pose = false;
  };

  // A key press ("space", "a", ...) or a received message (drama::Message).
  void PressKey(std::string_view key) {
    const std::lock_guard lock(mutex_);
    drama::AddKey(key, values_.keys);
  }
  void SetHour(float hour) { Set(&Values::hour, hour); }
  // Turns audio descriptions on or off. This does not change the drama.
  void SetDescriptions(bool on) { Set(&Values::describes, on); }
  // Avoids gliding corrections for visitors who are sensitive to motion: people fade instead.
  void SetReducedMotion(bool on) { Set(&Values::reduced_motion, on); }
  // Holds the drama or lets it go on. A show that has joined a group ignores this.
  void Hold(bool on) { Set(&Values::holds, on); }
  // The next frame continues the drama from this time (seconds): for the next visitor, or after a
  // restart. People appear only after tracking has found a pose again.
  void RestartAt(double seconds) {
    Set(&Values::restart, std::clamp(seconds, 0.0, drama::Drama::kMaxTime));
  }
  // Treats the next frame's pose as unrelated to the previous ones and does not smooth it. The
  // drama continues.
  void ForgetPose() { Set(&Values::forgets_pose, true); }

  // Returns the input, and clears what applies to one frame only.
  Values Take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(values_, {.hour = values_.hour,
                                   .describes = values_.describes,
                                   .reduced_motion = values_.reduced_motion,
                                   .holds = values_.holds});
  }

 private:
  template <typename Field, typename Value>
  void Set(Field Values::*field, const Value& value) {
    const std::lock_guard lock(mutex_);
    values_.*field = value;
  }

  std::mutex mutex_;
  Values values_;
};

}  // namespace lararium::show
