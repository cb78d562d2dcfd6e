#pragma once

// The animations of a scene as clips of the skeleton.

#include <string>
#include <vector>

#include "editor/import/model_bind_pose.h"
#include "editor/import/model_scene.h"
#include "editor/import/model_skeleton.h"
#include "shared/human/clip.h"

namespace lararium::import {

// Each animation sampled about so often; the last key is at its very end. Clips keep where
// they go; they loop where they end as they begin. "Armature|Walk" is Walk; names are given
// once. Errors: too long, or keys that are no numbers.
Result<std::vector<human::Clip>> SampleClips(const ModelScene& model,
                                             const BindPose& bind,
                                             const ModelSkeleton& skeleton,
                                             float keys_per_second);

}  // namespace lararium::import
