#pragma once

#include <string>
#include <string_view>

namespace lararium::import {

// The H-Anim name of a joint of another rig (Mixamo, MakeHuman, Rigify, Unreal:
// "mixamorig:LeftArm", "upperarm_l", "shin.R", ...), or the name as it is where
// it is no known synonym.
std::string HAnimName(std::string_view name);

}  // namespace lararium::import
