#pragma once

// From the project to the bundle that visitors get.

#include <filesystem>

#include "editor/app/project.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

// Bakes what is stale and packs all places, the cast and the drama. On failure a
// bundle that was there before is left as it was.
Status ExportProject(const ProjectPaths& paths,
                     const ProjectDocument& document,
                     const std::filesystem::path& out,
                     Progress& progress);

}  // namespace lararium::app
