#pragma once

// `lararium-editor probe ...`: light probes from photographs, and what is in them.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/status.h"

namespace lararium::app {

Result<CommandResult> RunProbe(const ProbeOptions& options);

}  // namespace lararium::app
