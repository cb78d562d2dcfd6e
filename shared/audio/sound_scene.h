#pragma once

// The sounds at one moment of a drama: a state, not events. The player compares it with the sounds
// that are playing already; therefore seeking, pausing and starting late need no special cases.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/stage/acoustics.h"

namespace lararium::audio {

// Groups of voices. Effects and ambience are lowered during speech, and all buses during an audio
// description.
enum class Bus : uint8_t { kSpeech, kEffects, kAmbience, kDescription };

// A playing sound.
struct Voice {
  uint64_t source = 0;  // Identifies the source; the same from moment to moment.
  int clip = -1;        // Index into the SoundLibrary.
  Bus bus = Bus::kEffects;
  double began = 0.0;  // Drama time in seconds at which the clip began; may be negative.
  bool loops = false;
  float gain = 1.0f;                     // Linear; 1: the clip's own level at 1 m.
  bool head_locked = false;              // Moves with the listener's head.
  glm::vec3 position = glm::vec3(0.0f);  // Stage axes, metres; unused if head-locked.
  glm::vec3 facing = glm::vec3(0.0f);    // Direction of a mouth; zero: omnidirectional.
  float obstruction = 0.0f;              // 0: unobstructed; 1: behind an occluder.
};

// The visitor's ears, in stage axes. forward and up are unit and perpendicular.
struct Listener {
  glm::vec3 position = glm::vec3(0.0f);
  glm::vec3 forward = glm::vec3(0.0f, 0.0f, -1.0f);
  glm::vec3 up = glm::vec3(0.0f, 1.0f, 0.0f);
};

struct SoundScene {
  double time = 0.0;        // Time of the drama, seconds.
  double frame_time = 0.0;  // Time of the frame, seconds since the first frame.
  // The drama is paused while frames continue: only ambience is heard.
  bool held = false;
  Listener listener;
  stage::Reverb reverb = stage::Reverb::kNone;
  float reverb_db = 0.0f;
  std::vector<Voice> voices;  // Each has a different `source`.
};

}  // namespace lararium::audio
