#pragma once

// Finds the pose at rest of a skeleton without a skin.

#include <optional>
#include <string>
#include <vector>

#include "editor/import/model/model_bind_pose.h"
#include "editor/import/model/model_rig.h"
#include "editor/import/model/model_scene.h"

namespace lararium::import {

// Joints of motion files may be oriented such that their zero pose shows no person, for example
// one with all bones along the X axis, or one that lies where the motion stands. Then this gives
// a pose of the longest animation, and adds a note: that in which the trunk is the most upright
// while the feet are together, with each leg as it is where it is the most upright and straight.
// Gives nullopt if the pose at rest stands as the motion does, or if the motion never stands.
std::optional<std::vector<glm::mat4>> FindRestInMotion(const ModelScene& model,
                                                       const ModelRig& rig,
                                                       std::vector<std::string>& notes);

}  // namespace lararium::import
