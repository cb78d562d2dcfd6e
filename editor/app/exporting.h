#pragma once

// From the project to the bundle that visitors get.

#include <filesystem>

#include "editor/app/project.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

// What a visitor needs of a map that was made for editing: fewer points, looks and
// images locate just as well (docs/benchmarks.md).
struct MapBudget {
  int max_points = 10'000;
  int max_descriptors_per_point = 3;
  double image_coverage = 0.98;
};

struct ExportRequest {
  std::filesystem::path out;
  MapBudget budget = {};
  std::filesystem::path key = {};  // a secret key's file; empty: the show is not signed
};

// Bakes what is stale, packs all places, the cast and the drama, and signs that. On failure a
// bundle that was there before is left as it was.
Status ExportProject(const ProjectPaths& paths,
                     const ProjectDocument& document,
                     const ExportRequest& request,
                     Progress& progress);

}  // namespace lararium::app
