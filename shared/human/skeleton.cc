#include "shared/human/skeleton.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <set>

#include "shared/human/finite.h"

namespace lararium::human {
namespace {

bool IsAffine(const glm::mat4& m) {
  return m[0].w == 0.0f && m[1].w == 0.0f && m[2].w == 0.0f && m[3].w == 1.0f;
}

}  // namespace

glm::mat4 ParentFromJoint(const JointTransform& joint) {
  glm::mat4 matrix = glm::mat4_cast(joint.rotation);
  for (int column = 0; column < 3; ++column) {
    matrix[column] *= joint.scale[column];
  }
  matrix[3] = glm::vec4(joint.translation, 1.0f);
  return matrix;
}

std::optional<size_t> Skeleton::Find(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    return std::nullopt;
  }
  return static_cast<size_t>(found - names.begin());
}

Status Skeleton::Validate(const std::string& where) const {
  if (names.empty() || names.size() > kMaxJoints) {
    return Status::Error(where, "the skeleton has " + std::to_string(names.size()) + " joints",
                         "it must have 1 to " + std::to_string(kMaxJoints));
  }
  if (parents.size() != size() || rest.size() != size() || joint_from_actor.size() != size()) {
    return Status::Error(where, "the skeleton's arrays differ in length");
  }
  std::set<std::string_view> seen;
  for (size_t i = 0; i < size(); ++i) {
    const std::string joint = "joint " + std::to_string(i) + " (" + names[i] + ")";
    if (names[i].empty() || !seen.insert(names[i]).second) {
      return Status::Error(where, joint + " has no name, or the name of another joint");
    }
    if (parents[i] < kNoParent || parents[i] >= static_cast<int>(i)) {
      return Status::Error(where, joint + " does not come after its parent");
    }
    if (!Valid(rest[i]) || !Finite(joint_from_actor[i]) || !IsAffine(joint_from_actor[i])) {
      return Status::Error(where, joint + " has an invalid transform");
    }
  }
  return Status();
}

void ComputeActorFromJoint(const Skeleton& skeleton,
                           std::span<const JointTransform> pose,
                           std::span<glm::mat4> actor_from_joint) {
  CHECK(pose.size() == skeleton.size() && actor_from_joint.size() == skeleton.size());
  for (size_t i = 0; i < skeleton.size(); ++i) {
    const glm::mat4 parent_from_joint = ParentFromJoint(pose[i]);
    const int16_t parent = skeleton.parents[i];
    actor_from_joint[i] = parent == Skeleton::kNoParent
                              ? parent_from_joint
                              : actor_from_joint[parent] * parent_from_joint;
  }
}

void ComputeSkinMatrices(const Skeleton& skeleton,
                         std::span<const glm::mat4> actor_from_joint,
                         std::span<glm::mat4> skin) {
  CHECK(actor_from_joint.size() == skeleton.size() && skin.size() == skeleton.size());
  for (size_t i = 0; i < skeleton.size(); ++i) {
    skin[i] = actor_from_joint[i] * skeleton.joint_from_actor[i];
  }
}

}  // namespace lararium::human
