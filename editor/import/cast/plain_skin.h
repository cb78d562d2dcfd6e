#pragma once

// Skin weights of the plain figure over the joints of PlainSkeleton().

#include <cstddef>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "editor/import/cast/plain_shapes.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// (joint, weight); weights may have any sum.
using JointShares = std::vector<std::pair<size_t, float>>;

// The left joint that mirrors a right one.
size_t MirroredJoint(const human::Skeleton& skeleton, size_t joint);

// Points are in the actor frame, metres, in the rest pose.
class PlainSkin {
 public:
  // Keeps a reference to the skeleton.
  explicit PlainSkin(const human::Skeleton& skeleton);

  JointShares Spine(const glm::vec3& p) const;
  JointShares Leg(const glm::vec3& p) const;                       // Right side.
  JointShares Arm(const glm::vec3& p, const PlainArm& arm) const;  // Right side.
  JointShares Cloth(const glm::vec3& p) const;

 private:
  struct Link {
    size_t joint;
    glm::vec3 position;
    glm::vec3 direction;  // Unit vector across the plane at which the joint takes over.
    float half_width;     // Half the width of the blend, metres.
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
