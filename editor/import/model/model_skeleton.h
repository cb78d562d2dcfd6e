#pragma once

// Builds the skeleton in the actor frame from the rig of a scene.

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/model/model_bind_pose.h"
#include "editor/import/model/model_parts.h"
#include "editor/import/model/model_rig.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

struct ModelSkeleton {
  glm::mat4 actor_from_scene = glm::mat4(1.0f);
  human::Skeleton joints;  // Frames are parallel to the actor's; the rest pose is the bind pose.
  std::vector<glm::vec3> positions;   // Positions of the joints in the bind pose, actor frame.
  std::vector<size_t> node_of_joint;  // The node of the scene for each joint.
  // The joint of each node, or of its nearest ancestor that is a joint.
  std::vector<uint32_t> joint_of_node;
};

// Bones become joints if they are mapped, move vertices or swing, or are between such bones.
// Joints have the H-Anim name from the map, otherwise the unique name of the bone. If `parts`
// is empty because only motion is imported, all bone nodes become joints. Errors: no joint, or
// more than human::Skeleton::kMaxJoints. Scenery has one joint, its root.
Result<ModelSkeleton> BuildSkeleton(const ModelScene& model,
                                    const BindPose& bind,
                                    std::span<const Part> parts,
                                    const ModelRig& rig,
                                    Content content,
                                    const glm::mat4& actor_from_scene);

}  // namespace lararium::import
