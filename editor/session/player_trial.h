#pragma once

// Tries an exported show in the player that visitors use.

#include <filesystem>
#include <string>
#include <vector>

#include "editor/document/project.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// The path of the player beside this program. Where it is not there: its name, to be found in PATH.
std::filesystem::path FindPlayer();

// The player's arguments for a place: plays the recording of the camera view in a loop, or uses the
// camera where the recording does not exist.
std::vector<std::string> TrialArguments(const ProjectPaths& paths,
                                        const PlaceDocument& place,
                                        const std::filesystem::path& show);

// Runs a program (a file or a name in PATH) until it ends. Cancelling asks it to end. Fails where
// it cannot be run or ends with an error; the message has its last output.
Status RunProgram(const std::filesystem::path& program,
                  const std::vector<std::string>& arguments,
                  Progress& progress);

}  // namespace lararium::editor
