#pragma once

// The subcommand occluder: edits occluders.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Performs the edit, if one is given, saves the project, and lists the occluders of one place
// or all.
Result<CommandResult> RunOccluder(const OccluderOptions& options);

}  // namespace lararium::editor
