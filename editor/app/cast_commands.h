#pragma once

// The subcommand cast: what the window does with the people of a project.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/status.h"

namespace lararium::app {

// Adds or changes a member, of whom only what the options say becomes different, and builds them;
// or removes one; or lists the cast.
Result<CommandResult> RunCast(const CastOptions& options);

}  // namespace lararium::app
