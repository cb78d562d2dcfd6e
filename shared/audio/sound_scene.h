#pragma once

// What is to be heard at one moment of a drama: a state, not events. Whoever plays it
// compares it with what sounds already, so that seeking, pausing and starting late
// are right by themselves.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/stage/acoustics.h"

namespace lararium::audio {

// What gives way to what: effects and ambience while somebody speaks, all while something is
// described.
enum class Bus : uint8_t { kSpeech, kEffects, kAmbience, kDescription };

// Something that sounds.
struct Voice {
  uint64_t source = 0;  // who or what it is: the same from moment to moment
  int clip = -1;        // index into the SoundLibrary
  Bus bus = Bus::kEffects;
  double began = 0.0;  // when the clip began, seconds of the drama; may lie before 0
  bool loops = false;
  float gain = 1.0f;                     // linear; 1: the clip's own level at 1 m
  bool head_locked = false;              // around the listener's head, whichever way it turns
  glm::vec3 position = glm::vec3(0.0f);  // stage, metres; unless head-locked
  glm::vec3 facing = glm::vec3(0.0f);    // where a mouth points; zero: it sounds all around
  float obstruction = 0.0f;              // 0: heard freely; 1: behind something solid
};

// The visitor's ears. Stage axes; forward and up are unit and perpendicular.
struct Listener {
  glm::vec3 position = glm::vec3(0.0f);
  glm::vec3 forward = glm::vec3(0.0f, 0.0f, -1.0f);
  glm::vec3 up = glm::vec3(0.0f, 1.0f, 0.0f);
};

struct SoundScene {
  double time = 0.0;        // of the drama, seconds
  double frame_time = 0.0;  // of the pictures, seconds since the first of them
  // The drama stands still while pictures go on: only ambience is heard.
  bool held = false;
  Listener listener;
  stage::Reverb reverb = stage::Reverb::kNone;
  float reverb_db = 0.0f;
  std::vector<Voice> voices;  // sources are unique
};

}  // namespace lararium::audio
