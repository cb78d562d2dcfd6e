#pragma once

// The subcommands project, place and locate: what the window does with a project, its places and
// the files that it names.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/status.h"

namespace lararium::app {

// Changes what is given, and tells what the project holds.
Result<CommandResult> RunProject(const ProjectOptions& options);

// Names a file that has moved, and those that moved along, where they are now; lists what is
// missing then.
Result<CommandResult> RunLocate(const LocateOptions& options);

// Does the work, if there is one, and lists the places.
Result<CommandResult> RunPlace(const PlaceOptions& options);

}  // namespace lararium::app
