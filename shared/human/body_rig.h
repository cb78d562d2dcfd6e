#pragma once

// Finds which joints of a skeleton are which parts of a human body, and measures the body. It uses
// the rest pose alone and makes no assumption about the axes of joints. Every part may be missing;
// code that moves bodies moves only the parts that exist.

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/skeleton.h"

namespace lararium::human {

// Indices of arrays that hold one element for each side.
inline constexpr int kRight = 0;
inline constexpr int kLeft = 1;
// +1 towards the actor's right (+X), -1 towards the left.
inline constexpr float SideSign(int side) { return side == kRight ? 1.0f : -1.0f; }

using JointIndex = int16_t;
inline constexpr JointIndex kNoJoint = -1;

// A joint in the actor frame. `scale` is exact only where all scales are uniform, because shear is
// not represented.
struct JointFrame {
  glm::quat rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  glm::vec3 position = glm::vec3(0.0f);
  glm::vec3 scale = glm::vec3(1.0f);

  glm::vec3 operator*(const glm::vec3& point) const {
    return position + rotation * (scale * point);
  }
};

// Returns one joint of a pose in the actor frame, by walking up its ancestors.
JointFrame ActorFromJoint(const Skeleton& skeleton,
                          std::span<const JointTransform> pose,
                          JointIndex joint);

// Turns a joint and its descendants so that the rotation of its actor_from_joint becomes the given
// one.
void SetActorRotation(const Skeleton& skeleton,
                      JointIndex joint,
                      const glm::quat& actor_from_joint,
                      std::span<JointTransform> pose);

// Moves a joint and its descendants to a position in the actor frame.
void SetActorPosition(const Skeleton& skeleton,
                      JointIndex joint,
                      const glm::vec3& position,
                      std::span<JointTransform> pose);

// Turns a joint and its descendants by a rotation given in actor axes.
void TurnInActor(const Skeleton& skeleton,
                 JointIndex joint,
                 const glm::quat& turn,
                 std::span<JointTransform> pose);

struct BodyRig {
  struct Arm {
    JointIndex clavicle = kNoJoint;  // sternoclavicular
    JointIndex shoulder = kNoJoint;
    JointIndex elbow = kNoJoint;
    JointIndex wrist = kNoJoint;
    std::vector<JointIndex> forearm_twist;  // The joints between elbow and wrist.
    float upper_length = 0.0f;              // metres
    float lower_length = 0.0f;

    bool whole() const { return shoulder != kNoJoint && elbow != kNoJoint && wrist != kNoJoint; }
  };
  struct Leg {
    JointIndex hip = kNoJoint;
    JointIndex knee = kNoJoint;
    JointIndex ankle = kNoJoint;
    std::vector<JointIndex> toes;  // the joints at the ball of the foot
    float upper_length = 0.0f;     // metres
    float lower_length = 0.0f;
    // The flat foot at rest, relative to the ankle's projection on the floor, with the foot turned
    // to point along -Z; metres.
    float ankle_height = 0.0f;
    glm::vec3 heel = glm::vec3(0.0f);  // The heel on the floor.
    glm::vec3 ball = glm::vec3(0.0f);  // Position of the toe joints, at their height.
    float toe_out = 0.0f;              // Direction of the foot at rest, radians about +Y.

    bool whole() const { return hip != kNoJoint && knee != kNoJoint && ankle != kNoJoint; }
  };
  // A finger's joints from the knuckle outward, without metacarpals.
  struct Finger {
    std::array<JointIndex, 3> joints = {kNoJoint, kNoJoint, kNoJoint};
  };
  static constexpr int kThumb = 0;  // Index, middle, ring and little finger are 1 to 4.
  static constexpr int kFingers = 5;

  JointIndex root = kNoJoint;     // the pelvis
  std::vector<JointIndex> spine;  // Joints above the root up to the chest, which bears the arms.
  std::vector<JointIndex> neck;   // Joints above the chest up to and including the head.
  JointIndex head = kNoJoint;     // skullbase
  JointIndex jaw = kNoJoint;      // temporomandibular
  std::array<JointIndex, 2> eyes = {kNoJoint, kNoJoint};
  std::array<Arm, 2> arms;
  std::array<Leg, 2> legs;
  std::array<std::array<Finger, kFingers>, 2> fingers;

  std::vector<JointFrame> rest;  // Every joint in the actor frame at rest.
  // Height of the hip joints above the floor at rest, metres; 0 without legs.
  float hip_height = 0.0f;
  float hip_width = 0.0f;  // Distance between the hip joints, metres.
  // Distance from the hip joints to the floor, with which the gait scales. 0 without legs.
  float leg_length() const { return hip_height; }
  JointIndex chest() const { return spine.empty() ? root : spine.back(); }
  bool walks() const { return root != kNoJoint && legs[0].whole() && legs[1].whole(); }
};

BodyRig MakeBodyRig(const Skeleton& skeleton);

}  // namespace lararium::human
