#pragma once

// The text form of COLMAP models: one record per line (two lines for an image), fields separated by
// blanks, comments after #.

#include <string>

#include "editor/colmap/colmap_model.h"

namespace lararium::train {

// Errors name file and line. References and the range of numbers are checked by
// ColmapModel::Validate() only.
Status ParseColmapText(const ColmapFiles& files, const std::string& where, ColmapModel& model);
// Numbers are written with enough digits to be read back unchanged.
ColmapFiles SerializeColmapText(const ColmapModel& model);

}  // namespace lararium::train
