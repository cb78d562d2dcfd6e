#pragma once

// Finds a human body in a tree of bones without a look at names.

#include <string>
#include <vector>

#include "editor/import/bone_map.h"

namespace lararium::import {

// Limbs, head and fingers; the trunk between them follows from these. Empty where the
// tree is no body: two pairs of like limbs, one below a branch that bears the other and
// a head. Left and right follow from which way the feet point (else knees or elbows
// bend; else the figure is taken to face +Z, as glTF's do).
std::vector<MappedBone> MapByStructure(const Rig& rig);

}  // namespace lararium::import
