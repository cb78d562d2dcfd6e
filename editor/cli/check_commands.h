#pragma once

// The subcommand check-points: edits and evaluates check points (check_points.h).

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Performs the edit, if one is given, saves the project, and reports on one place or all. The
// result is "failed" if the stage is misplaced at a check point.
Result<CommandResult> RunCheckPoints(const CheckPointsOptions& options);

}  // namespace lararium::editor
