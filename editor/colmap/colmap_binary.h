#pragma once

// The binary form of COLMAP models: little-endian numbers without padding, in the layout of
// Reconstruction::ReadBinary of COLMAP 3.8.

#include <string>

#include "editor/colmap/colmap_model.h"

namespace lararium::train {

// Checks sizes and counts against the available bytes before anything is allocated. References and
// numbers are checked by ColmapModel::Validate() only.
Status ParseColmapBinary(const ColmapFiles& files, const std::string& where, ColmapModel& model);
ColmapFiles SerializeColmapBinary(const ColmapModel& model);

}  // namespace lararium::train
