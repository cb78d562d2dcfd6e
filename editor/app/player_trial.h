#pragma once

// Trying a show in the player that visitors use, from the editor.

#include <filesystem>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

// The player: beside this program, else its name, which PATH is searched for.
std::filesystem::path FindPlayer();

// How it is called for a place: with the recording that the camera view plays, round and
// round; where that is not there, with the camera.
std::vector<std::string> TrialArguments(const ProjectPaths& paths,
                                        const PlaceDocument& place,
                                        const std::filesystem::path& show);

// Runs a program, a file or a name on PATH, until it ends; cancelled, it is asked to end. Errors:
// it cannot be run, or ended badly, with the last that it said.
Status RunProgram(const std::filesystem::path& program,
                  const std::vector<std::string>& arguments,
                  Progress& progress);

}  // namespace lararium::app
