#pragma once

// The editing part of the subcommand timeline: the edits that the window offers by mouse.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Performs the edit, if one is given, writes drama.lua if it changed, and lists the items with
// the names that --item accepts. Runs the drama only if an item without a length is trimmed.
Result<CommandResult> EditTimeline(const TimelineOptions& options, Progress& progress);

}  // namespace lararium::editor
