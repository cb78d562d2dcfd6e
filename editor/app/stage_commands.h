#pragma once

// The subcommand stage: what the window does to lay the stage at a place.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/status.h"

namespace lararium::app {

// Does what is given, in the order of StageOptions, saves the project, and says how well the stage
// is known.
Result<CommandResult> RunStage(const StageOptions& options);

}  // namespace lararium::app
