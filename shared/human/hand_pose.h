#pragma once

// Named poses of a hand, from the geometry of whatever fingers there are.

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shared/human/body.h"
#include "shared/human/life.h"

namespace lararium::human {

enum class HandPose : uint8_t {
  kRelaxed,
  kFlat,
  kFist,
  kCylinder,  // around a cup or a handle
  kPinch,     // thumb and index finger: a coin
  kPoint,
  kLadle,  // around a thin handle, index finger along it
  kBowl,   // an open hand that carries from below
};
inline constexpr int kHandPoseCount = 8;
// relaxed, flat, fist, cylinder, pinch, point, ladle, bowl.
std::optional<HandPose> HandPoseNamed(std::string_view name);
std::string_view NameOf(HandPose pose);

// All that one hand remembers; plain values.
struct HandState {
  HandPose pose = HandPose::kRelaxed;                 // where it goes
  std::array<float, kHandPoseCount> shares = {1.0f};  // of each pose now, together 1
  float change_per_second = 4.0f;
  float strength = 1.0f;  // against what a clip does with the fingers, 0..1

  friend bool operator==(const HandState&, const HandState&) = default;
};

// Closes or opens the hand over so many seconds.
void SetHandPose(HandState& hand, HandPose pose, float seconds);
void UpdateHand(HandState& hand, float seconds);
HandState Interpolate(const HandState& previous, const HandState& current, float alpha);

// What hands know of one body; build once.
struct HandModel {
  struct Joint {
    JointIndex joint = kNoJoint;
    uint8_t finger = 0;                                      // Body::kThumb ...
    uint8_t segment = 0;                                     // 0 at the knuckle
    bool last = false;                                       // of its finger
    glm::quat straight = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);  // parent_from_joint, stretched
    glm::vec3 flexion = glm::vec3(1.0f, 0.0f, 0.0f);         // axes in the joint's frame
    glm::vec3 spread = glm::vec3(0.0f, 1.0f, 0.0f);
  };
  std::array<std::vector<Joint>, 2> joints;
};
HandModel MakeHandModel(const Skeleton& skeleton, const Body& body);

void ApplyHand(const HandModel& model,
               const HandState& state,
               const LifeSample& life,
               int side,
               std::span<JointTransform> pose);

}  // namespace lararium::human
