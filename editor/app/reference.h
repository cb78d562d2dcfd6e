#pragma once

// Reference images: a person in a probe's light, path-traced or lit as the player does
// it, from one camera and in linear radiance, so that the two can be compared.

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

Result<CommandResult> RunReference(const ReferenceOptions& options, Progress& progress);

}  // namespace lararium::app
