#pragma once

// Pictures of people in a studio, off screen: to judge a figure by, and the
// contact sheet of a cast.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/status.h"

namespace lararium::app {

// Writes the picture. Errors name the file, view, shape or clip that does not exist.
Result<CommandResult> RunPortrait(const PortraitOptions& options);

}  // namespace lararium::app
