#pragma once

// The editor's window.

#include <filesystem>

#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Opens the project in a window and returns when the window is closed. Without a project it shows
// the start page.
Status RunWindow(const std::filesystem::path& project, Log& log);

}  // namespace lararium::editor
