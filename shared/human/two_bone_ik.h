#pragma once

// Two segments that bend so that the end of the second is somewhere: arms and legs.

#include <glm/vec3.hpp>
#include <span>

#include "shared/human/body.h"

namespace lararium::human {

// Analytic: the law of cosines in the plane of target and pole. Joints in between keep
// their turns. Actor frame.
struct TwoBoneIk {
  // Below this share of full stretch the end is on the target; beyond it stretches
  // more and more slowly, so that no joint snaps straight.
  static constexpr float kExact = 0.996f;

  JointIndex upper = kNoJoint;  // hip, shoulder
  JointIndex lower = kNoJoint;  // knee, elbow
  JointIndex end = kNoJoint;    // ankle, wrist
  glm::vec3 target = glm::vec3(0.0f);
  glm::vec3 pole = glm::vec3(0.0f);   // where the middle joint points to, a direction
  glm::vec3 hinge = glm::vec3(0.0f);  // its axis in the rest pose: what a straight limb bends about

  // Leaves the direction of what the end bears as it comes. Returns by how much the end
  // misses the target, metres.
  float Solve(const Skeleton& skeleton, const Body& body, std::span<JointTransform> pose) const;
};

// How much of the foot's turn the knee takes part in.
inline constexpr float kKneeTurn = 0.6f;

// Bends a whole leg so that its foot is there again: ankle in the actor frame. The knee
// points between where the body faces and where the foot does.
void BringFoot(const Skeleton& skeleton,
               const Body& body,
               int side,
               const JointFrame& ankle,
               std::span<JointTransform> pose);

}  // namespace lararium::human
