#pragma once

// Tries an exported show in the player that visitors use.

#include <filesystem>
#include <string>
#include <vector>

#include "editor/document/project.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// The player's arguments for a place: plays the recording of the camera view in a loop, or uses the
// camera where the recording does not exist.
std::vector<std::string> TrialArguments(const ProjectPaths& paths,
                                        const PlaceDocument& place,
                                        const std::filesystem::path& show);

// Runs the player until it ends. Cancelling asks it to end.
Status RunPlayer(const std::vector<std::string>& arguments, Progress& progress);

}  // namespace lararium::editor
