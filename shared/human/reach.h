#pragma once

// A hand that goes to a grip, stays there and comes back.

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body.h"

namespace lararium::human {

// The frame of a palm. Origin: the middle of the palm's surface. Axes as the actor's
// when the hand lies flat on a table before it, palm down, fingers forward: -Z along
// the fingers, +Y out of the back of the hand, +X to the right (the right thumb is on
// -X, the left one on +X). What a closed hand holds is 2 to 4 cm along -Y.
struct GripFrame {
  glm::vec3 position = glm::vec3(0.0f);  // metres
  glm::quat rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);

  friend bool operator==(const GripFrame&, const GripFrame&) = default;
};
// By weight of b, rotations on the shorter arc.
GripFrame Mix(const GripFrame& a, const GripFrame& b, float weight);

// All that one reaching hand remembers; plain values. The hand is at grip to a share
// of weight and where the body puts it to the rest.
struct Reach {
  GripFrame from;  // actor frame, when the motion began
  GripFrame to;    // where it ends: move it as the grip moves
  float from_weight = 0.0f;
  float to_weight = 0.0f;
  float time = 0.0f;      // seconds since the motion began
  float duration = 0.0f;  // of the motion

  friend bool operator==(const Reach&, const Reach&) = default;
};

// From wherever the hand is to a grip in the actor frame.
void StartReach(Reach& reach, const GripFrame& actor_from_grip, float seconds);
// The grip has moved; the motion goes on.
void MoveGrip(Reach& reach, const GripFrame& actor_from_grip);
// Back to where the body puts the hand.
void EndReach(Reach& reach, float seconds);
void UpdateReach(Reach& reach, float seconds);
Reach Interpolate(const Reach& previous, const Reach& current, float alpha);

// How far along: 0 begins, 1 has arrived. Minimum jerk (Flash & Hogan, J. Neurosci. 5,
// 1985).
float Progress(const Reach& reach);
// The grip that the hand is drawn to, and how much.
struct ReachGoal {
  GripFrame actor_from_grip;
  float weight = 0.0f;
};
ReachGoal Goal(const Reach& reach);
// A natural duration for a hand's way of so many metres, seconds.
float ReachSeconds(float metres);

// What reaching knows of one body; build once.
struct ReachModel {
  Body body;
  std::array<GripFrame, 2> wrist_from_grip;  // of each palm
};
ReachModel MakeReachModel(const Body& body);

// Where the palm of a pose is.
GripFrame ActorFromPalm(const ReachModel& model,
                        const Skeleton& skeleton,
                        std::span<const JointTransform> pose,
                        int side);

// Bends trunk, and knees for what is low, towards grips that arms cannot reach alone.
// Feet stay. seated: 0..1, how much a seat bears the body: hips that it bears stay too.
void ApplyReachPosture(const ReachModel& model,
                       const Skeleton& skeleton,
                       const std::array<Reach, 2>& reaches,
                       float seated,
                       std::span<JointTransform> pose);
// Then clavicle and arm bring the palm to its grip.
void ApplyReach(const ReachModel& model,
                const Skeleton& skeleton,
                const Reach& reach,
                int side,
                std::span<JointTransform> pose);

}  // namespace lararium::human
