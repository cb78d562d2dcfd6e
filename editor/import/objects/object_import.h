#pragma once

// Imports the author's own objects: models from other programs, and real objects at the place
// that only need a description.

#include <filesystem>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// Reads a model (glTF, FBX, ...). NAME.object.json beside it describes its use, otherwise the
// `object` in the extras of its scene (glTF); its nodes become parts, at most Prop::kMaxParts that
// have meshes or lead to such parts. Without either it is scenery of one part. The file may also
// be NAME.object.json itself: a real object, which is used and not drawn. What the reader guessed
// or left out is added to `notes`.
Result<stage::Prop> ImportObject(const std::filesystem::path& file,
                                 std::vector<std::string>& notes);

// The file for the use of a model.
std::filesystem::path UseFileBeside(const std::filesystem::path& model);

}  // namespace lararium::import
