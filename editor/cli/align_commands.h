#pragma once

// The subcommand align: aligns the model of an occluder with the real object
// (occluder_alignment.h), or moves the corners of a drawn occluder to a plane.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Performs the steps given, in the order of AlignOptions, saves the project, and reports.
Result<CommandResult> RunAlign(const AlignOptions& options, Progress& progress);

}  // namespace lararium::editor
