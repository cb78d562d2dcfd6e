#pragma once

// The binary form of COLMAP models: little-endian numbers without padding. Its
// layout is that of Reconstruction::ReadBinary of COLMAP 3.8.

#include <string>

#include "editor/train/colmap_model.h"

namespace lararium::train {

// Sizes and counts are checked against the bytes at hand before anything is
// allocated; references and numbers are Validate()'s to check.
Status ParseColmapBinary(const ColmapFiles& files, const std::string& place, ColmapModel& model);
ColmapFiles SerializeColmapBinary(const ColmapModel& model);

}  // namespace lararium::train
