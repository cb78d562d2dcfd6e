#pragma once

// Reference images. Of a .larhuman: the person in a probe's light, path-traced or lit as the
// player does it, from one camera and in linear radiance, so that the two can be compared. Of
// a project: a moment of its show, both ways side by side (scene_reference.h).

#include "editor/app/options.h"
#include "editor/app/subcommands.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

Result<CommandResult> RunReference(const ReferenceOptions& options, Progress& progress, Log& log);

}  // namespace lararium::app
