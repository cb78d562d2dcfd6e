#pragma once

// Which joints of a skeleton play which part of a human body, and its measures,
// from the rest pose alone: nothing is supposed about the axes of joints. Every
// part may be missing; whoever moves bodies moves what is there.

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/skeleton.h"

namespace lararium::human {

// Index arrays of two by side.
inline constexpr int kRight = 0;
inline constexpr int kLeft = 1;
// +1 towards the actor's right (+X), -1 towards the left.
inline constexpr float SideSign(int side) { return side == kRight ? 1.0f : -1.0f; }

using JointIndex = int16_t;
inline constexpr JointIndex kNoJoint = -1;

// A joint in the actor frame. Scales along turned axes are not kept apart: scale is
// exact where all scales are uniform.
struct JointFrame {
  glm::quat rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  glm::vec3 position = glm::vec3(0.0f);
  glm::vec3 scale = glm::vec3(1.0f);

  glm::vec3 operator*(const glm::vec3& point) const {
    return position + rotation * (scale * point);
  }
};

// One joint of a pose in the actor frame; walks up its ancestors.
JointFrame ActorFromJoint(const Skeleton& skeleton,
                          std::span<const JointTransform> pose,
                          JointIndex joint);

// Turns a joint, and with it all below, so that its actor_from_joint rotation
// becomes this.
void SetActorRotation(const Skeleton& skeleton,
                      JointIndex joint,
                      const glm::quat& actor_from_joint,
                      std::span<JointTransform> pose);

// Moves a joint, and with it all below, to a place in the actor frame.
void SetActorPosition(const Skeleton& skeleton,
                      JointIndex joint,
                      const glm::vec3& position,
                      std::span<JointTransform> pose);

// Turns a joint, and with it all below, by a rotation given in actor axes.
void TurnInActor(const Skeleton& skeleton,
                 JointIndex joint,
                 const glm::quat& turn,
                 std::span<JointTransform> pose);

struct Body {
  struct Arm {
    JointIndex clavicle = kNoJoint;  // sternoclavicular
    JointIndex shoulder = kNoJoint;
    JointIndex elbow = kNoJoint;
    JointIndex wrist = kNoJoint;
    std::vector<JointIndex> forearm_twist;  // between elbow and wrist
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
    // The flat foot at rest, from the ankle's projection on the floor, with the foot
    // turned to point along -Z; metres.
    float ankle_height = 0.0f;
    glm::vec3 heel = glm::vec3(0.0f);  // on the floor
    glm::vec3 ball = glm::vec3(0.0f);  // the toes' joints, at their height
    float toe_out = 0.0f;              // radians about +Y of the foot's direction at rest

    bool whole() const { return hip != kNoJoint && knee != kNoJoint && ankle != kNoJoint; }
  };
  // A finger's joints from the knuckle outward; metacarpals are left alone.
  struct Finger {
    std::array<JointIndex, 3> joints = {kNoJoint, kNoJoint, kNoJoint};
  };
  static constexpr int kThumb = 0;  // then index, middle, ring, little finger
  static constexpr int kFingers = 5;

  JointIndex root = kNoJoint;     // the pelvis
  std::vector<JointIndex> spine;  // above the root up to the chest, which bears the arms
  std::vector<JointIndex> neck;   // above the chest up to the head, which it includes
  JointIndex head = kNoJoint;     // skullbase
  JointIndex jaw = kNoJoint;      // temporomandibular
  std::array<JointIndex, 2> eyes = {kNoJoint, kNoJoint};
  std::array<Arm, 2> arms;
  std::array<Leg, 2> legs;
  std::array<std::array<Finger, kFingers>, 2> fingers;

  std::vector<JointFrame> rest;  // of every joint, actor frame
  float hip_height = 0.0f;       // metres above the floor at rest; 0 without legs
  float hip_width = 0.0f;        // between the hip joints
  // From the hip joints to the floor; what gait scales with. 0 without legs.
  float leg_length() const { return hip_height; }
  JointIndex chest() const { return spine.empty() ? root : spine.back(); }
  bool walks() const { return root != kNoJoint && legs[0].whole() && legs[1].whole(); }
};

Body MakeBody(const Skeleton& skeleton);

}  // namespace lararium::human
