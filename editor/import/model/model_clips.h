#pragma once

// Samples the animations of a scene as clips of the skeleton.

#include <vector>

#include "editor/import/model/model_bind_pose.h"
#include "editor/import/model/model_scene.h"
#include "editor/import/model/model_skeleton.h"
#include "shared/human/clip.h"

namespace lararium::import {

// Samples each animation at about this rate, with the last key exactly at its end. Clips keep
// their root motion; they loop if the end equals the beginning. "Armature|Walk" becomes Walk,
// and names are unique. What clips move besides nodes is listed in `notes`. Errors: a clip that is
// too long, or keys that are not finite.
Result<std::vector<human::Clip>> SampleClips(const ModelScene& model,
                                             const BindPose& bind,
                                             const ModelSkeleton& skeleton,
                                             float keys_per_second,
                                             std::vector<std::string>& notes);

}  // namespace lararium::import
