#pragma once

// The editor's commands about lines: translations in, captions out.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/progress.h"

namespace lararium::app {

// Takes over a gettext catalogue, or replaces the table by another one.
Result<CommandResult> RunLines(const LinesOptions& options);

// Runs the drama dry and writes what was to be read, by the drama's time.
Result<CommandResult> RunCaptions(const CaptionsOptions& options, Progress& progress);

}  // namespace lararium::app
