#pragma once

// The text form of COLMAP models: one record a line (two for an image), fields
// apart by blanks, comments after #.

#include <string>

#include "editor/train/colmap_model.h"

namespace lararium::train {

// Errors name file and line. References and the range of numbers are Validate()'s to check.
Status ParseColmapText(const ColmapFiles& files, const std::string& place, ColmapModel& model);
// Numbers are written so that they read back as they are.
ColmapFiles SerializeColmapText(const ColmapModel& model);

}  // namespace lararium::train
