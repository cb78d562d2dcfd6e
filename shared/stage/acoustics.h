#pragma once

// How a place sounds: what is always heard there, and how its walls answer.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lararium::stage {

// Rooms by what they are built of; the player has a preset of late reverberation for
// each (audio/sound_graph.cc).
enum class Reverb : uint8_t {
  kNone,
  kSmallRoom,   // plaster and furniture
  kWoodenRoom,  // planks
  kStoneRoom,   // bare masonry
  kCorridor,
  kHall,
  kVault,  // a large vaulted space
  kCourtyard,
  kStreet,
};

// Something that is heard as long as one is there.
struct Ambience {
  std::string sound;                  // name of a sound of the project
  float gain_db = 0.0f;               // -60..12
  std::optional<glm::vec3> position;  // stage, metres; none: all around the listener

  friend bool operator==(const Ambience&, const Ambience&) = default;
};

struct Acoustics {
  static constexpr size_t kMaxAmbience = 16;

  Reverb reverb = Reverb::kNone;
  float reverb_db = 0.0f;  // of the late sound, -60..12
  std::vector<Ambience> ambience;

  friend bool operator==(const Acoustics&, const Acoustics&) = default;
};

}  // namespace lararium::stage
