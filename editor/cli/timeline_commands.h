#pragma once

// The subcommands timeline and import-bml: exchange the timeline of a drama with other
// programs.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Edits the timeline (timeline_item_commands.h). With an output file, runs the drama without
// pictures and writes the items of its tracks and the actions of its script.
Result<CommandResult> RunTimeline(const TimelineOptions& options, Progress& progress);

// Adds the behaviours of a BML block to the tracks in drama.lua.
Result<CommandResult> RunImportBml(const ImportBmlOptions& options);

}  // namespace lararium::editor
