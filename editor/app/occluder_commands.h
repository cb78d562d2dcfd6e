#pragma once

// The subcommand occluder: what the window does with occluders.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/status.h"

namespace lararium::app {

// Does the work, if there is one, saves the project, and lists the occluders of the place or of all
// of them.
Result<CommandResult> RunOccluder(const OccluderOptions& options);

}  // namespace lararium::app
