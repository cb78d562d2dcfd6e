#pragma once

// `lararium-editor probe list|add|set|remove PROJECT`: what the window does with the light probes
// of a place.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/status.h"

namespace lararium::app {

// Does the work, saves the project, and lists the probes of the place, or of all of them.
Result<CommandResult> RunPlaceProbe(const ProbeOptions& options);

}  // namespace lararium::app
