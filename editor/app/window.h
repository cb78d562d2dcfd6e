#pragma once

// The editor's window.

#include "editor/app/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::app {

// Opens the project in a window and returns when it is closed. Without a project
// the start page is shown.
Status RunWindow(const WindowOptions& options, Log& log);

}  // namespace lararium::app
