#pragma once

#include <string>
#include <vector>

#include "editor/colmap/colmap_model.h"

namespace lararium::train {

// Makes features and points refer to each other where other programs left that incomplete. The
// lists of the model must be sorted by id.
// - If no point lists observations, those of the features are taken.
// - If no image lists features, the projections of its points are taken.
// - References that have no counterpart are dropped.
// Returns what was done, in sentences for the user.
std::vector<std::string> RepairColmapModel(ColmapModel& model);

}  // namespace lararium::train
