#pragma once

// Looking at a target with eyes, then head, then torso; and blinks.

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body_rig.h"

namespace lararium::human {

enum class GazeKind : uint8_t {
  kNothing,  // straight ahead, wandering a little
  kObject,
  kPerson,  // meets the eyes and looks away now and then
};

// The complete state of gaze, as plain values. Angles are in radians: x is yaw to the left (about
// +Y), y is pitch upwards.
struct Gaze {
  // Inputs: the target to look at. Set them before each update.
  GazeKind kind = GazeKind::kNothing;
  glm::vec3 target = glm::vec3(0.0f);  // stage, metres
  bool speaking = false;               // speakers look away more often

  uint64_t random = 0;  // state of the random number generator
  bool started = false;
  glm::vec3 fixation = glm::vec3(0.0f);  // Point on which the eyes rest, stage frame.
  glm::vec3 saccade_from = glm::vec3(0.0f);
  float saccade_time = 0.0f;           // seconds since the saccade began
  float saccade_duration = 0.0f;       // 0: no saccade
  float latency = 0.0f;                // seconds until the next saccade may begin
  glm::vec2 wander = glm::vec2(0.0f);  // Small offset of the target.
  float wander_left = 0.0f;            // Seconds that the offset remains.
  glm::vec2 aversion = glm::vec2(0.0f);
  float aversion_left = 0.0f;        // Seconds; negative: time until the next aversion.
  glm::vec2 head = glm::vec2(0.0f);  // Head direction against the chest's rest direction.
  glm::vec2 head_rate = glm::vec2(0.0f);
  float torso = 0.0f;  // Yaw of the chest against the pelvis.
  float torso_rate = 0.0f;
  float lids = 0.0f;         // 0 is open, 1 is closed
  float blink_time = -1.0f;  // seconds since the blink began; negative: no blink
  float next_blink = 0.0f;   // seconds until the next blink
  float weight = 0.0f;       // 0: the pose decides the head's direction; 1: gaze decides it.

  friend bool operator==(const Gaze&, const Gaze&) = default;
};

// Constants of one body for gaze; build once.
struct GazeModel {
  BodyRig body;
  glm::vec3 eyes = glm::vec3(0.0f, 1.6f, 0.0f);  // Midpoint between the eyes at rest, actor frame.
  bool has_eyes = false;
};
GazeModel MakeGazeModel(const BodyRig& body);

// Anatomical limits in radians: eyes in the head (Guitton & Volle, J. Neurophysiol. 58, 1987: up to
// 55 degrees, of which people use less), head on the trunk, and twist of the trunk.
struct GazeLimits {
  static constexpr float kEyeYaw = 0.61f;    // 35 degrees
  static constexpr float kEyeUp = 0.44f;     // 25 degrees
  static constexpr float kEyeDown = 0.61f;   // 35 degrees
  static constexpr float kHeadYaw = 1.05f;   // 60 degrees
  static constexpr float kHeadUp = 0.52f;    // 30 degrees
  static constexpr float kHeadDown = 0.70f;  // 40 degrees
  static constexpr float kTorsoYaw = 0.52f;  // 30 degrees
};

// Advances one tick. position and heading are those of the root in the stage frame; seed is the
// person's.
void UpdateGaze(const GazeModel& model,
                const glm::vec3& position,
                float heading,
                uint64_t seed,
                float seconds,
                Gaze& state);

Gaze Interpolate(const Gaze& previous, const Gaze& current, float alpha);

// Turns torso and head. Then turns the eyes, within their limits, to the fixation from wherever the
// pose has put them (the vestibulo-ocular reflex).
void ApplyGaze(const GazeModel& model,
               const Skeleton& skeleton,
               const Gaze& state,
               const glm::vec3& position,
               float heading,
               std::span<JointTransform> pose);

}  // namespace lararium::human
