#pragma once

// The subcommand stage: registers the stage at a place.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Performs the steps given, in the order of StageOptions, saves the project, and reports how
// accurately the stage is known.
Result<CommandResult> RunStage(const StageOptions& options);

}  // namespace lararium::editor
