#pragma once

// Looking at things: eyes, then head, then torso; blinks.

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body.h"

namespace lararium::human {

enum class GazeKind : uint8_t {
  kNothing,  // straight ahead, wandering a little
  kObject,
  kPerson,  // meets the eyes and looks away now and then
};

// All that gaze remembers; plain values. Angles in radians: x yaw to the left (about
// +Y), y pitch up.
struct Gaze {
  // What to look at: set before each update.
  GazeKind kind = GazeKind::kNothing;
  glm::vec3 target = glm::vec3(0.0f);  // stage, metres
  bool speaking = false;               // speakers look away more often

  uint64_t random = 0;  // state of the random numbers; 0: from the seed
  bool started = false;
  glm::vec3 fixation = glm::vec3(0.0f);  // stage: the point on which the eyes rest
  glm::vec3 saccade_from = glm::vec3(0.0f);
  float saccade_time = 0.0f;           // seconds since the saccade began
  float saccade_duration = 0.0f;       // 0: no saccade
  float latency = 0.0f;                // seconds until the next saccade may begin
  glm::vec2 wander = glm::vec2(0.0f);  // small shift of the target
  float wander_left = 0.0f;            // seconds that it lasts
  glm::vec2 aversion = glm::vec2(0.0f);
  float aversion_left = 0.0f;        // seconds; below 0: until the next one
  glm::vec2 head = glm::vec2(0.0f);  // of the head against the chest's rest direction
  glm::vec2 head_rate = glm::vec2(0.0f);
  float torso = 0.0f;  // yaw of the chest against the pelvis
  float torso_rate = 0.0f;
  float lids = 0.0f;         // 0 open .. 1 closed
  float blink_time = -1.0f;  // seconds since the blink began; below 0: none
  float next_blink = 0.0f;   // seconds
  float weight = 0.0f;       // 0: the head moves as the body does, 1: as gaze says

  friend bool operator==(const Gaze&, const Gaze&) = default;
};

// What gaze knows of one body; build once.
struct GazeModel {
  Body body;
  glm::vec3 eyes = glm::vec3(0.0f, 1.6f, 0.0f);  // between the eyes at rest, actor frame
  bool has_eyes = false;
};
GazeModel MakeGazeModel(const Body& body);

// Anatomical limits, radians. Eyes in the head (Guitton & Volle, J. Neurophysiol. 58,
// 1987: up to 55 degrees; what people use is less), head on the trunk, trunk twist.
struct GazeLimits {
  static constexpr float kEyeYaw = 0.61f;    // 35 degrees
  static constexpr float kEyeUp = 0.44f;     // 25
  static constexpr float kEyeDown = 0.61f;   // 35
  static constexpr float kHeadYaw = 1.05f;   // 60
  static constexpr float kHeadUp = 0.52f;    // 30
  static constexpr float kHeadDown = 0.70f;  // 40
  static constexpr float kTorsoYaw = 0.52f;  // 30
};

// One tick. position and heading: the root, stage frame. seed: the person's.
void UpdateGaze(const GazeModel& model,
                const glm::vec3& position,
                float heading,
                uint64_t seed,
                float seconds,
                Gaze& state);

Gaze Interpolate(const Gaze& previous, const Gaze& current, float alpha);

// Turns torso and head; then the eyes rest on the fixation wherever the pose has put
// them (the vestibulo-ocular reflex), within their limits.
void ApplyGaze(const GazeModel& model,
               const Skeleton& skeleton,
               const Gaze& state,
               const glm::vec3& position,
               float heading,
               std::span<JointTransform> pose);

}  // namespace lararium::human
