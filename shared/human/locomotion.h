#pragma once

// Walking, turning, starting and stopping. The owner of the person moves the root over the floor.
// The feet follow in steps and stay planted in the stage frame between them; pelvis, trunk and arms
// move to match the steps.
//
// Cadence follows the walk ratio (Sekiya & Nagasaki, Gait & Posture 7, 1998: step length over
// cadence hardly depends on speed) and scales with body size by dimensionless numbers (Hof, Gait &
// Posture 4, 1996). Angles of pelvis, legs, trunk and arms follow Perry & Burnfield (Gait Analysis,
// 2010), Winter (Biomechanics and Motor Control of Human Movement, 2009) and Murray et al. (J. Bone
// Joint Surg. 46-A, 1964; Am. J. Phys. Med. 46, 1967). docs/architecture.md says how closely.

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "shared/human/body_rig.h"
#include "shared/human/idle_motion.h"

namespace lararium::human {

struct Human;

// A person's style of walking. The defaults are those of a healthy adult.
struct GaitStyle {
  float cadence = 1.0f;     // factor; children step faster, old people slower
  float step_width = 1.0f;  // factor on the distance between the lines of the two feet
  float stoop = 0.0f;       // radians by which the trunk leans forward
  float arm_swing = 1.0f;   // factor
  float arm_spread = 0.0f;  // radians by which the arms hang further out, for stout people
  float sway = 1.0f;        // factor on the sideways motion of the pelvis
  float lift = 1.0f;        // factor on how high the feet are lifted; old people shuffle
  // Factor on the lead of the right foot while standing; below 0 the left foot leads.
  float stagger = 1.0f;

  friend bool operator==(const GaitStyle&, const GaitStyle&) = default;
};

// Accepts normal (or grown), child, stout, old, tired, proud and hurried. The values are set by eye
// from what is known of such walks: children step faster; stout people place their feet further
// apart; old people take shorter steps, with a stoop and little arm swing; sad and tired people
// stoop and hardly swing their arms (Michalak et al., Psychosom. Med. 71, 2009).
std::optional<GaitStyle> GaitStyleNamed(std::string_view name);

// Height of the floor in the stage frame, metres, at x and z.
using FloorHeight = std::function<float(float x, float z)>;

// The complete state of walking, as plain values. Positions are in metres in the stage frame;
// headings are in radians about +Y, and 0 faces -Z.
struct Locomotion {
  struct Footprint {
    glm::vec3 position = glm::vec3(0.0f);  // Projection of the ankle onto the floor.
    float heading = 0.0f;                  // Heading of the foot.
    float slope_pitch = 0.0f;  // Pitch of the floor under the foot; positive raises the toes.
    float slope_roll = 0.0f;   // Roll of the floor under the foot; positive lowers the right side.

    friend bool operator==(const Footprint&, const Footprint&) = default;
  };
  struct Foot {
    bool planted = true;
    Footprint print;        // The current print; in swing, the flat foot under the swinging one.
    Footprint lifted_from;  // Last print, while the foot swings.
    Footprint goal;         // Predicted next print, while the foot swings.
    // Position of the ankle when the foot left the floor.
    glm::vec3 lifted_ankle = glm::vec3(0.0f);
    glm::vec3 lifted_velocity = glm::vec3(0.0f);
    float lifted_pitch = 0.0f;
    float lift_phase = 0.0f;  // Phase of this foot's own stride at which it left the floor.
    float swing = 0.0f;       // Progress of the swing, 0..1.
    glm::vec3 ankle = glm::vec3(0.0f);     // Target position of the ankle joint.
    glm::vec3 velocity = glm::vec3(0.0f);  // Velocity of the ankle, m/s.
    float pitch = 0.0f;     // Pitch of the sole against the print; positive raises the toes.
    float toe_bend = 0.0f;  // Upward bend of the toes against the sole.

    friend bool operator==(const Foot&, const Foot&) = default;
  };

  GaitStyle style;
  bool placed = false;                   // If false, the next update puts both feet down.
  glm::vec3 position = glm::vec3(0.0f);  // Position of the root: the floor between the feet.
  float heading = 0.0f;
  glm::vec3 velocity = glm::vec3(0.0f);      // m/s, smoothed
  float turn_rate = 0.0f;                    // rad/s, smoothed
  glm::vec3 acceleration = glm::vec3(0.0f);  // m/s^2, smoothed
  double phase = 0.0;  // Phase in strides; a whole number when the right heel strikes.
  bool stepping = false;
  float settled = 0.0f;  // Reaches 1 after standing for a while; then the weight may shift.
  float amount = 0.0f;   // Amount of walking: 0 stands, 1 is a comfortable speed, faster is more.
  std::array<Foot, 2> feet;

  friend bool operator==(const Locomotion&, const Locomotion&) = default;
};

// Constants of one body for locomotion; build once.
struct LocomotionModel {
  BodyRig body;
  // Radians by which the arms hang outward, so that the hands clear the hips and the clothes there.
  float arm_spread = 0.12f;
};
LocomotionModel MakeLocomotionModel(const Human& human, const BodyRig& body);

// Advances one tick, after the root has moved to this position and heading. If the root moved
// further than kTeleport in the tick, both feet are put down at the new position. Without a floor
// function the feet stand at the root's height.
inline constexpr float kTeleport = 0.25f;  // metres
void UpdateLocomotion(const LocomotionModel& model,
                      const glm::vec3& position,
                      float heading,
                      float seconds,
                      const FloorHeight& floor,
                      Locomotion& state);

// Interpolates between two neighbouring ticks, alpha 0..1. Returns current after a teleport.
Locomotion Interpolate(const Locomotion& previous, const Locomotion& current, float alpha);

// Poses the whole body except hands and face, starting from the rest pose. Draw the person at the
// state's position and heading, otherwise planted feet slide.
void ApplyLocomotion(const LocomotionModel& model,
                     const Skeleton& skeleton,
                     const Locomotion& state,
                     const IdleMotionSample& idle_motion,
                     std::span<JointTransform> pose);

}  // namespace lararium::human
