#pragma once

// The subcommands object and sound: edit objects on the stage, and sounds.

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Performs the edit, if one is given, and lists the objects.
Result<CommandResult> RunObject(const ObjectOptions& options);

// Performs the edits given, and lists the sounds of the project, the missing ones, and the
// acoustics of places.
Result<CommandResult> RunSound(const SoundOptions& options);

}  // namespace lararium::editor
