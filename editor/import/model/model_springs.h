#pragma once

// Reads the spring bones of a VRM and their colliders.

#include <vector>

#include "editor/import/model/model_bind_pose.h"
#include "editor/import/model/model_scene.h"
#include "editor/import/model/model_skeleton.h"
#include "shared/human/soft_parts.h"

namespace lararium::import {

// Each spring reaches as far as its nodes are joints, each the parent of the next; springs of
// fewer than two joints are left out. Empty if the scene is not a VRM.
std::vector<human::SpringChain> BuildSprings(const ModelScene& model,
                                             const ModelSkeleton& skeleton);

// Invalid colliders are left out.
std::vector<human::BodyCapsule> BuildCapsules(const ModelScene& model,
                                              const BindPose& bind,
                                              const ModelSkeleton& skeleton);

}  // namespace lararium::import
