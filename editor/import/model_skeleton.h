#pragma once

// The skeleton that a scene's rig becomes, in the actor frame.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/model_bind_pose.h"
#include "editor/import/model_parts.h"
#include "editor/import/model_rig.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

struct ModelSkeleton {
  glm::mat4 actor_from_scene = glm::mat4(1.0f);
  human::Skeleton joints;               // frames parallel to the actor's; at rest as bound
  std::vector<glm::vec3> positions;     // of the joints, bind pose, actor frame
  std::vector<size_t> node_of_joint;    // the scene's node that each joint is
  std::vector<uint32_t> joint_of_node;  // or of the nearest node above that is a joint
};

// Bones become joints that are mapped, move vertices or swing, and what lies between. Joints
// bear H-Anim's names where the map knows them, else the bones' own, each once. parts: empty
// where only the motion is wanted; all bone nodes become joints then. Errors: no joint, or
// more than human::Skeleton::kMaxJoints.
Result<ModelSkeleton> BuildSkeleton(const ModelScene& model,
                                    const BindPose& bind,
                                    std::span<const Part> parts,
                                    const ModelRig& rig,
                                    const glm::mat4& actor_from_scene);

}  // namespace lararium::import
