#pragma once

// Reads BVH (Biovision hierarchical data) to a scene of assimp, whose own reader refuses much of
// what other programs write. Internal to editor/import.

#include <assimp/scene.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::import {

// The scene has a node for each joint of the first root, and one named "EndSite_<joint>" for each
// end, in the units of the file, with one animation of one key per frame. Rotations apply in the
// order of their channels; a position channel replaces the component of OFFSET.
//
// Read as well: names with blanks, upper and lower case of words, comments (lines that begin with
// "#" or "//"), byte order marks, any line ends, decimal commas, frames that are broken over
// several lines. What is unusual is listed in `notes`: further roots, missing offsets, another
// number of frames than stated, a missing frame time, values that are no numbers (those of the
// frame before stay). Errors name `where` and the line.
Result<std::unique_ptr<aiScene>> ReadBvhScene(std::string_view text,
                                              const std::string& where,
                                              std::vector<std::string>& notes);

// True for text whose first word is HIERARCHY.
bool LooksLikeBvh(std::string_view text);

}  // namespace lararium::import
