#pragma once

// The subcommands project, place and locate: edit a project, its places and the paths of its
// files.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Changes the given properties and reports the content of the project.
Result<CommandResult> RunProject(const ProjectOptions& options);

// Sets the new path of a moved file and of the files moved with it; then lists the missing
// files.
Result<CommandResult> RunLocate(const LocateOptions& options);

// Performs the edit, if one is given, and lists the places.
Result<CommandResult> RunPlace(const PlaceOptions& options);

}  // namespace lararium::editor
