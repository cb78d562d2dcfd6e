#pragma once

// The subcommand timeline where it edits: what the hand does to items in the window.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

// Does the work, if there is one, writes drama.lua where that changed it, and lists the items, each
// as --item names it. The drama is run dry only where something is trimmed that says no length.
Result<CommandResult> EditTimeline(const TimelineOptions& options, Progress& progress);

}  // namespace lararium::app
