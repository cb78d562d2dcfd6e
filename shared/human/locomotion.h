#pragma once

// Walking, turning, starting and stopping. Whoever owns the person moves its root
// over the floor; the feet follow in steps, planted in the stage frame in between,
// and the body moves as bodies do over such steps.
//
// Cadence follows the walk ratio (Sekiya & Nagasaki, Gait & Posture 7, 1998: step
// length over cadence hardly depends on speed), scaled to body size without
// dimension (Hof, Gait & Posture 4, 1996). Angles of pelvis, legs, trunk and arms
// follow Perry & Burnfield (Gait Analysis, 2010), Winter (Biomechanics and Motor
// Control of Human Movement, 2009) and Murray et al. (J. Bone Joint Surg. 46-A,
// 1964; Am. J. Phys. Med. 46, 1967); docs/architecture.md says how closely.

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "shared/human/body.h"
#include "shared/human/life.h"

namespace lararium::human {

struct Human;

// How somebody walks; what a grown healthy person does is 1 or 0.
struct GaitStyle {
  float cadence = 1.0f;     // factor; children step faster, the old slower
  float step_width = 1.0f;  // factor of the distance between the lines of the feet
  float stoop = 0.0f;       // radians by which the trunk leans forward
  float arm_swing = 1.0f;   // factor
  float arm_spread = 0.0f;  // radians by which arms hang further out: stout people
  float sway = 1.0f;        // factor of the pelvis' motion from side to side
  float lift = 1.0f;        // factor of how high feet are lifted; the old shuffle
  float stagger = 1.0f;     // standing, the right foot is ahead: factor; below 0 the left

  friend bool operator==(const GaitStyle&, const GaitStyle&) = default;
};

// normal (or grown), child, stout, old, tired, proud, hurried: set by eye, after what is
// known of such walks (children step faster, the stout more broadly; the old more shortly,
// with a stoop and little swing; the sad and tired stoop and hardly swing their arms,
// Michalak et al., Psychosom. Med. 71, 2009).
std::optional<GaitStyle> GaitStyleNamed(std::string_view name);

// Height of the floor in the stage frame, metres, at x and z.
using FloorHeight = std::function<float(float x, float z)>;

// All that walking remembers; plain values. Positions in metres, stage frame;
// headings in radians about +Y, 0 faces -Z.
struct Locomotion {
  struct Footprint {
    glm::vec3 position = glm::vec3(0.0f);  // of the ankle's projection on the floor
    float heading = 0.0f;                  // of the foot
    float slope_pitch = 0.0f;              // of the floor under the foot, toes up
    float slope_roll = 0.0f;               // likewise, right side down

    friend bool operator==(const Footprint&, const Footprint&) = default;
  };
  struct Foot {
    bool planted = true;
    Footprint print;                           // where it stands, or the flat foot in swing
    Footprint lifted_from;                     // in swing: the last print
    Footprint goal;                            // in swing: the next print, foretold
    glm::vec3 lifted_ankle = glm::vec3(0.0f);  // where the ankle left
    glm::vec3 lifted_velocity = glm::vec3(0.0f);
    float lifted_pitch = 0.0f;
    float lift_phase = 0.0f;               // of its own stride, when it left
    float swing = 0.0f;                    // 0..1 of the swing
    glm::vec3 ankle = glm::vec3(0.0f);     // where the ankle joint is to be
    glm::vec3 velocity = glm::vec3(0.0f);  // of the ankle, m/s
    float pitch = 0.0f;                    // toes up, of the sole against the print
    float toe_bend = 0.0f;                 // of the toes against the sole, up

    friend bool operator==(const Foot&, const Foot&) = default;
  };

  GaitStyle style;
  bool placed = false;                   // false: the next update puts both feet down
  glm::vec3 position = glm::vec3(0.0f);  // of the root: the ground between the feet
  float heading = 0.0f;
  glm::vec3 velocity = glm::vec3(0.0f);      // m/s, smoothed
  float turn_rate = 0.0f;                    // rad/s, smoothed
  glm::vec3 acceleration = glm::vec3(0.0f);  // m/s^2, smoothed
  double phase = 0.0;  // of the stride, in strides; whole when the right heel strikes
  bool stepping = false;
  float settled = 0.0f;  // 1 when it has stood for a while: weight may shift
  float amount = 0.0f;   // of walking: 0 stands, 1 at a comfortable speed, more beyond
  std::array<Foot, 2> feet;

  friend bool operator==(const Locomotion&, const Locomotion&) = default;
};

// What locomotion knows of one body; build once.
struct LocomotionModel {
  Body body;
  // By how much arms hang out, radians, so that hands pass the hips and what is worn there.
  float arm_spread = 0.12f;
};
LocomotionModel MakeLocomotionModel(const Human& human, const Body& body);

// One tick: the root has come to this place. Steps longer than kTeleport in one tick
// put the feet down anew. Without a floor the feet stand at the root's height.
inline constexpr float kTeleport = 0.25f;  // metres
void UpdateLocomotion(const LocomotionModel& model,
                      const glm::vec3& position,
                      float heading,
                      float seconds,
                      const FloorHeight& floor,
                      Locomotion& state);

// Between two neighbouring ticks, alpha 0..1; current after a teleport.
Locomotion Interpolate(const Locomotion& previous, const Locomotion& current, float alpha);

// Poses the whole body but hands and face, from the rest pose on. The person must be
// drawn with the state's position and heading, or planted feet slide.
void ApplyLocomotion(const LocomotionModel& model,
                     const Skeleton& skeleton,
                     const Locomotion& state,
                     const LifeSample& life,
                     std::span<JointTransform> pose);

}  // namespace lararium::human
