#pragma once

// The acoustics of a place: its ambient sounds and its reverberation.

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lararium::stage {

// Kind of room. The player has a preset of late reverberation for each (audio/sound_graph.cc).
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

// A sound that is heard as long as the listener is in the place.
struct Ambience {
  std::string sound;                  // Name of a sound of the project.
  float gain_db = 0.0f;               // -60..12
  std::optional<glm::vec3> position;  // Stage frame, metres; none: from all directions.

  friend bool operator==(const Ambience&, const Ambience&) = default;
};

struct Acoustics {
  static constexpr size_t kMaxAmbience = 16;

  Reverb reverb = Reverb::kNone;
  float reverb_db = 0.0f;  // Gain of the late reverberation, -60..12.
  std::vector<Ambience> ambience;

  friend bool operator==(const Acoustics&, const Acoustics&) = default;
};

}  // namespace lararium::stage
