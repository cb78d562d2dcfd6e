#pragma once

// Named poses of a hand, computed from the geometry of the fingers that exist.

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shared/human/body_rig.h"
#include "shared/human/idle_motion.h"

namespace lararium::human {

enum class HandPose : uint8_t {
  kRelaxed,
  kFlat,
  kFist,
  kCylinder,  // around a cup or a handle
  kPinch,     // thumb and index finger, as for a coin
  kPoint,
  kLadle,  // around a thin handle, with the index finger along it
  kBowl,   // an open hand that carries from below
};
inline constexpr int kHandPoseCount = 8;
// Accepts relaxed, flat, fist, cylinder, pinch, point, ladle and bowl.
std::optional<HandPose> HandPoseNamed(std::string_view name);
std::string_view NameOf(HandPose pose);

// The complete state of one hand, as plain values.
struct HandState {
  HandPose pose = HandPose::kRelaxed;                 // The pose that the hand moves to.
  std::array<float, kHandPoseCount> shares = {1.0f};  // Current share of each pose; their sum is 1.
  float change_per_second = 4.0f;
  float strength = 1.0f;  // Weight against the fingers of a clip, 0..1.

  friend bool operator==(const HandState&, const HandState&) = default;
};

// Moves to a hand pose within the given number of seconds.
void SetHandPose(HandState& hand, HandPose pose, float seconds);
void UpdateHand(HandState& hand, float seconds);
HandState Interpolate(const HandState& previous, const HandState& current, float alpha);

// Constants of one body's hands; build once.
struct HandModel {
  struct Joint {
    JointIndex joint = kNoJoint;
    uint8_t finger = 0;   // finger as counted in BodyRig: kThumb, ...
    uint8_t segment = 0;  // 0 at the knuckle
    bool last = false;    // True for the last joint of its finger.
    // parent_from_joint of the stretched finger
    glm::quat straight = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
    glm::vec3 flexion = glm::vec3(1.0f, 0.0f, 0.0f);  // axes of rotation in the joint's frame
    glm::vec3 spread = glm::vec3(0.0f, 1.0f, 0.0f);
  };
  std::array<std::vector<Joint>, 2> joints;
};
HandModel MakeHandModel(const Skeleton& skeleton, const BodyRig& body);

void ApplyHand(const HandModel& model,
               const HandState& state,
               const IdleMotionSample& idle_motion,
               int side,
               std::span<JointTransform> pose);

}  // namespace lararium::human
