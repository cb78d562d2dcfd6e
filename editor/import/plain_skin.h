#pragma once

// How much each joint of PlainSkeleton() moves a point of the plain figure.

#include <cstddef>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "editor/import/plain_shapes.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

using JointShares = std::vector<std::pair<size_t, float>>;  // joint, weight; any sum

// The joint of the left side that answers to one of the right.
size_t MirroredJoint(const human::Skeleton& skeleton, size_t joint);

// Points are in the actor frame, metres, in the rest pose.
class PlainSkin {
 public:
  // Borrows the skeleton.
  explicit PlainSkin(const human::Skeleton& skeleton);

  JointShares Spine(const glm::vec3& p) const;
  JointShares Leg(const glm::vec3& p) const;                       // of the right side
  JointShares Arm(const glm::vec3& p, const PlainArm& arm) const;  // of the right side
  JointShares Cloth(const glm::vec3& p) const;

 private:
  struct Link {
    size_t joint;
    glm::vec3 position;
    glm::vec3 direction;  // unit, across the plane where the joint takes over
    float half_width;     // of the blend, metres
  };

  static JointShares ChainShares(const glm::vec3& p, const std::vector<Link>& chain);
  Link Joint(const char* name, const glm::vec3& direction, float half_width) const;
  Link HeadLink() const;
  glm::vec3 Direction(const char* from, const char* to) const;
  JointShares Skirt(const glm::vec3& p) const;
  JointShares MirrorJoints(JointShares shares) const;

  const human::Skeleton& skeleton_;
  std::vector<Link> spine_, leg_, arm_;
  size_t thumb_ = 0;
  size_t skirt_[6] = {};
};

}  // namespace lararium::import
