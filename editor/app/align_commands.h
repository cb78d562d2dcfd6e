#pragma once

// The subcommand align: what the window does to lay an occluder's model where the real thing is
// (occluder_alignment.h), or a drawn one's corners onto a plane.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

// Does the work, if there is one, in the order of AlignOptions, saves the project, and reports.
Result<CommandResult> RunAlign(const AlignOptions& options, Progress& progress);

}  // namespace lararium::app
