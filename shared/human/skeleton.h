#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::human {

// The joint frame in its parent's frame, or in the actor's frame for a root.
struct JointTransform {
  glm::quat rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);
  glm::vec3 translation = glm::vec3(0.0f);  // metres
  glm::vec3 scale = glm::vec3(1.0f);
};

glm::mat4 ParentFromJoint(const JointTransform& joint);

// A skeleton whose parents come before their children. Names are those of H-Anim (humanoid_root,
// sacroiliac, vl5, skullbase, l_shoulder, ...). Actor frame: metres, Y up, facing -Z, soles at y =
// 0.
struct Skeleton {
  static constexpr int16_t kNoParent = -1;
  static constexpr size_t kMaxJoints = 256;

  std::vector<std::string> names;
  std::vector<int16_t> parents;
  std::vector<JointTransform> rest;         // parent_from_joint
  std::vector<glm::mat4> joint_from_actor;  // inverse bind matrices

  size_t size() const { return names.size(); }
  std::optional<size_t> Find(std::string_view name) const;
  Status Validate(const std::string& where) const;
};

// Computes actor_from_joint for every joint of a pose.
void ComputeActorFromJoint(const Skeleton& skeleton,
                           std::span<const JointTransform> pose,
                           std::span<glm::mat4> actor_from_joint);

// Computes actor_from_joint * joint_from_actor, which moves vertices from the bind pose to the
// pose: the input of linear blend skinning.
void ComputeSkinMatrices(const Skeleton& skeleton,
                         std::span<const glm::mat4> actor_from_joint,
                         std::span<glm::mat4> skin);

}  // namespace lararium::human
