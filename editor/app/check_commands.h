#pragma once

// The subcommand check-points: what the window does with check points (check_points.h).

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/status.h"

namespace lararium::app {

// Does the work, if there is one, saves the project, and reports on the place or on all of them.
// Failed: the stage lies wrongly at one of them.
Result<CommandResult> RunCheckPoints(const CheckPointsOptions& options);

}  // namespace lararium::app
