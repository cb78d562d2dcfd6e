#pragma once

// The subcommands lines and captions: edit and translate lines, import and export captions.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/progress.h"

namespace lararium::editor {

// Edits the table, imports a gettext catalogue, or replaces the table by another. Without an
// edit, or after it, lists the lines.
Result<CommandResult> RunLines(const LinesOptions& options);

// Runs the drama without pictures and writes its captions in the time of the drama, or imports
// captions.
Result<CommandResult> RunCaptions(const CaptionsOptions& options, Progress& progress);

}  // namespace lararium::editor
