#pragma once

// Objects of one's own: models from other programs, and real things that are there
// already and only have to be known.

#include <filesystem>

#include "shared/core/status.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// A model (glTF, FBX, ...): its nodes become parts, at most Prop::kMaxParts that bear
// meshes or lead to such. How it is used is in NAME.object.json beside it, else in the
// `object` of the extras of its scene (glTF), else nowhere: scenery.
// NAME.object.json itself: something real, which is used and not drawn.
Result<stage::Prop> ImportObject(const std::filesystem::path& file);

// Where the use of a model may be written.
std::filesystem::path UseFileBeside(const std::filesystem::path& model);

}  // namespace lararium::import
