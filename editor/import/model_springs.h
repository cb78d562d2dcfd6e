#pragma once

// What swings on a VRM, and what it collides with.

#include <vector>

#include "editor/import/model_bind_pose.h"
#include "editor/import/model_scene.h"
#include "editor/import/model_skeleton.h"
#include "shared/human/soft_parts.h"

namespace lararium::import {

// Each spring as far as its nodes are joints, each the parent of the next; of fewer than two
// joints nothing is made. None where the scene is no VRM.
std::vector<human::SpringChain> BuildSprings(const ModelScene& model,
                                             const ModelSkeleton& skeleton);

// Those that make sense.
std::vector<human::BodyCapsule> BuildCapsules(const ModelScene& model,
                                              const BindPose& bind,
                                              const ModelSkeleton& skeleton);

}  // namespace lararium::import
