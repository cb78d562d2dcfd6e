#pragma once

// Moves a hand to a grip, keeps it there and moves it back.

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body_rig.h"

namespace lararium::human {

// The frame of a palm. The origin is the middle of the palm's surface. The axes are those of the
// actor when the hand lies flat on a table in front of the actor, palm down and fingers forward: -Z
// along the fingers, +Y out of the back of the hand, +X to the right (the right thumb is on -X, the
// left one on +X). An object in a closed hand is 2 to 4 cm along -Y.
struct GripFrame {
  glm::vec3 position = glm::vec3(0.0f);  // metres
  glm::quat rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);

  friend bool operator==(const GripFrame&, const GripFrame&) = default;
};
// Mixes by the weight of b; rotations take the shorter arc.
GripFrame Mix(const GripFrame& a, const GripFrame& b, float weight);

// The complete state of one reaching hand, as plain values. The hand is at the grip by a share of
// `weight`, and otherwise where the body's pose puts it.
struct Reach {
  GripFrame from;  // Actor frame, at the start of the motion.
  GripFrame to;    // Goal of the motion; MoveGrip() updates it when the grip moves.
  float from_weight = 0.0f;
  float to_weight = 0.0f;
  float time = 0.0f;      // seconds since the motion began
  float duration = 0.0f;  // seconds of the whole motion

  friend bool operator==(const Reach&, const Reach&) = default;
};

// Starts moving from the current position of the hand to a grip in the actor frame.
void StartReach(Reach& reach, const GripFrame& actor_from_grip, float seconds);
// Updates the goal after the grip has moved; the motion continues.
void MoveGrip(Reach& reach, const GripFrame& actor_from_grip);
// Starts moving back to where the body's pose puts the hand.
void EndReach(Reach& reach, float seconds);
void UpdateReach(Reach& reach, float seconds);
Reach Interpolate(const Reach& previous, const Reach& current, float alpha);

// Progress of the motion, from 0 at its start to 1 at its end. Minimum jerk (Flash & Hogan, J.
// Neurosci. 5, 1985).
float Progress(const Reach& reach);
// The current grip and its weight against the body's pose.
struct ReachGoal {
  GripFrame actor_from_grip;
  float weight = 0.0f;
};
ReachGoal Goal(const Reach& reach);
// A natural duration in seconds for a hand that moves by this distance.
float ReachSeconds(float metres);

// Constants of one body for reaching; build once.
struct ReachModel {
  BodyRig body;
  std::array<GripFrame, 2> wrist_from_grip;  // index: side
};
ReachModel MakeReachModel(const BodyRig& body);

// Returns the palm's frame in a pose.
GripFrame ActorFromPalm(const ReachModel& model,
                        const Skeleton& skeleton,
                        std::span<const JointTransform> pose,
                        int side);

// Bends the trunk, and the knees for low grips, towards grips that the arms alone cannot reach. The
// feet stay in place. seated, 0..1: the share of the body's weight on a seat, by which the hips
// stay in place too.
void ApplyReachPosture(const ReachModel& model,
                       const Skeleton& skeleton,
                       const std::array<Reach, 2>& reaches,
                       float seated,
                       std::span<JointTransform> pose);
// Moves clavicle and arm so that the palm is at its grip. Call it after ApplyReachPosture.
void ApplyReach(const ReachModel& model,
                const Skeleton& skeleton,
                const Reach& reach,
                int side,
                std::span<JointTransform> pose);

}  // namespace lararium::human
