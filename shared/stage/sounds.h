#pragma once

// Sounds that the drama plays explicitly, such as bells, voices or music. Sounds of people and
// objects are not listed here: they follow from the state of the stage.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/ease.h"
#include "shared/core/status.h"
#include "shared/stage/navigation.h"
#include "shared/stage/object.h"

namespace lararium::stage {

// A sound that is playing.
struct StageSound {
  enum class At : uint8_t { kListener, kPoint, kActor, kObject };

  uint32_t number = 0;  // Consecutive number of the playback; 0: none.
  int sound = -1;       // Index of a sound that Sounds::Add added.
  int64_t ticks = 0;    // Ticks since the sound began.
  bool loops = false;
  float gain_db = 0.0f;
  At at = At::kListener;
  glm::vec3 point = glm::vec3(0.0f);  // Stage frame, for At::kPoint.
  ActorId actor;
  ObjectId object;
  float fade = 0.0f;      // Fade-in, seconds.
  float fade_out = 0.0f;  // Fade-out after a stop, seconds.
  Ease ease = Ease::kLinear;
  int64_t stopped = kPlays;  // Value of `ticks` when the sound was stopped.

  static constexpr int64_t kPlays = -1;

  friend bool operator==(const StageSound&, const StageSound&) = default;
};

class Sounds {
 public:
  static constexpr size_t kMaxPlaying = 64;
  static constexpr double kTickSeconds = 1.0 / Navigation::kTicksPerSecond;

  // Names must be unique. `seconds` is the length of the sound; a looping sound ignores it.
  Status Add(std::string name, double seconds);
  std::optional<int> Find(std::string_view name) const;
  size_t size() const { return known_.size(); }
  double seconds(int sound) const { return known_[static_cast<size_t>(sound)].seconds; }

  // Starts a sound and returns its number; 0: kMaxPlaying sounds are already playing.
  uint32_t Play(const StageSound& sound);
  // Fades out all playbacks of a sound within `seconds` and ends them.
  void StopAll(int sound, double seconds = 0.0);
  // Factor of the gain at present because of fade-in and fade-out, 0..1.
  static float Share(const StageSound& sound);

  std::span<const StageSound> playing() const { return playing_; }  // Oldest first.

  // Advances by one tick.
  void Advance();
  void Reset();

  // The complete state, to return to later.
  struct Checkpoint {
    std::vector<StageSound> playing;
    uint32_t last_number = 0;
  };
  Checkpoint Save() const { return {playing_, last_number_}; }
  void Restore(const Checkpoint& checkpoint);

 private:
  struct Known {
    std::string name;
    double seconds = 0.0;
  };

  std::vector<Known> known_;
  std::vector<StageSound> playing_;
  uint32_t last_number_ = 0;
};

}  // namespace lararium::stage
