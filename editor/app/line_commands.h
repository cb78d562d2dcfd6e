#pragma once

// The editor's commands about lines: writing and translating them, captions out.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/progress.h"

namespace lararium::app {

// Edits the table as the window does, takes over a gettext catalogue, or replaces the table by
// another one; without a work, or after an edit, lists it.
Result<CommandResult> RunLines(const LinesOptions& options);

// Runs the drama dry and writes what was to be read, by the drama's time.
Result<CommandResult> RunCaptions(const CaptionsOptions& options, Progress& progress);

}  // namespace lararium::app
