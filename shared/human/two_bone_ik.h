#pragma once

// Inverse kinematics of two segments, for arms and legs.

#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body_rig.h"

namespace lararium::human {

// Analytic solution by the law of cosines in the plane of target and pole. Joints between upper,
// lower and end keep their rotations. Actor frame.
struct TwoBoneIk {
  // Below this share of full stretch the end is exactly on the target. Beyond it the limb stretches
  // more and more slowly, so that no joint snaps straight.
  static constexpr float kExact = 0.996f;

  JointIndex upper = kNoJoint;  // hip, shoulder
  JointIndex lower = kNoJoint;  // knee, elbow
  JointIndex end = kNoJoint;    // ankle, wrist
  glm::vec3 target = glm::vec3(0.0f);
  glm::vec3 pole = glm::vec3(0.0f);  // Direction towards which the middle joint points.
  // Axis of the middle joint in the rest pose, about which a straight limb bends.
  glm::vec3 hinge = glm::vec3(0.0f);

  // Poses the limb; the rotation of the end in the actor frame is not kept. Returns the distance in
  // metres by which the end misses the target.
  float Solve(const Skeleton& skeleton, const BodyRig& body, std::span<JointTransform> pose) const;
};

// Share of the foot's turn that the knee follows.
inline constexpr float kKneeTurn = 0.6f;

// Bends a leg so that its foot is at `ankle` (actor frame). The knee points between the directions
// of the body and of the foot.
void BringFoot(const Skeleton& skeleton,
               const BodyRig& body,
               int side,
               const JointFrame& ankle,
               std::span<JointTransform> pose);

}  // namespace lararium::human
