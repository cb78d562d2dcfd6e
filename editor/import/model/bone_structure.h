#pragma once

// Finds a human body in a tree of bones without using names.

#include <vector>

#include "editor/import/model/bone_map.h"

namespace lararium::import {

// Maps limbs, head and fingers; the trunk between them follows from these. Empty if the tree is
// not a body: two pairs of similar limbs, one below a branch that carries the other and a head.
// The direction of the feet determines left and right; otherwise the bend of knees or elbows;
// otherwise the figure is assumed to face +Z, as in glTF.
std::vector<MappedBone> MapByStructure(const Rig& rig);

}  // namespace lararium::import
