#pragma once

// A drama's timeline to other programs, and behaviours of other programs onto it.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

// Edits the timeline (timeline_item_commands.h); with a file to write, runs the drama dry and
// writes what its tracks say and what its script did.
Result<CommandResult> RunTimeline(const TimelineOptions& options, Progress& progress);

// Adds a BML block's behaviours to the tracks of drama.lua, in place.
Result<CommandResult> RunImportBml(const ImportBmlOptions& options);

}  // namespace lararium::app
