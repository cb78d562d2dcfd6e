#pragma once

// The subcommands object and sound: what the window does with things on the stage and with what
// is heard.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/status.h"

namespace lararium::app {

// Does the work, if there is one, and lists the objects.
Result<CommandResult> RunObject(const ObjectOptions& options);

// Does what is given, and lists the project's sounds, those that are missing, and how places sound.
Result<CommandResult> RunSound(const SoundOptions& options);

}  // namespace lararium::app
