#pragma once

// `lararium-editor probe list|add|set|remove PROJECT`: edits the light probes of a place.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Performs the edit, saves the project, and lists the probes of one place or all.
Result<CommandResult> RunPlaceProbe(const ProbeOptions& options);

}  // namespace lararium::editor
