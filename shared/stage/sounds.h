#pragma once

// The sounds that a drama plays by itself: bells, voices from nowhere, music. Those of
// people and objects follow from what they do.

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

// One that is heard.
struct StageSound {
  enum class At : uint8_t { kListener, kPoint, kActor, kObject };

  uint32_t number = 0;  // which of all that were played; 0 is none
  int sound = -1;       // index of the known sounds
  int64_t ticks = 0;    // since it began
  bool loops = false;
  float gain_db = 0.0f;
  At at = At::kListener;
  glm::vec3 point = glm::vec3(0.0f);  // stage
  ActorId actor;
  ObjectId object;
  // How it comes and goes.
  float fade = 0.0f;      // seconds
  float fade_out = 0.0f;  // likewise, once it is told to stop
  Ease ease = Ease::kLinear;
  int64_t stopped = kPlays;  // ticks when it was told to stop

  static constexpr int64_t kPlays = -1;

  friend bool operator==(const StageSound&, const StageSound&) = default;
};

class Sounds {
 public:
  static constexpr size_t kMaxPlaying = 64;
  static constexpr double kTickSeconds = 1.0 / Navigation::kTicksPerSecond;

  // Names are unique. seconds: after which it is over, unless it loops.
  Status Add(std::string name, double seconds);
  std::optional<int> Find(std::string_view name) const;
  size_t size() const { return known_.size(); }
  double seconds(int sound) const { return known_[static_cast<size_t>(sound)].seconds; }

  // Begins now; its number. 0: too many are heard at once.
  uint32_t Play(const StageSound& sound);
  // Wherever it is heard: fades out in so many seconds, then is over.
  void StopAll(int sound, double seconds = 0.0);
  // The share of its gain that is heard now, by its fades.
  static float Share(const StageSound& sound);

  std::span<const StageSound> playing() const { return playing_; }  // oldest first

  // One tick passes.
  void Advance();
  void Reset();

  // What is to be kept to come back to.
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
