#pragma once

// The subcommand cast: edits the people of a project.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Adds a member or changes the given properties of one, and builds the figure; or removes a
// member; or lists the cast.
Result<CommandResult> RunCast(const CastOptions& options);

}  // namespace lararium::editor
