#pragma once

// Exports a project as the bundle that visitors get.

#include <filesystem>
#include <optional>

#include "editor/document/project.h"
#include "shared/bundle/publication.h"
#include "shared/bundle/web_folder.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Limits that reduce a map for visitors: it locates equally well with fewer points, descriptors and
// images (docs/benchmarks.md).
struct MapBudget {
  int max_points = 10'000;
  int max_descriptors_per_point = 3;
  double image_coverage = 0.98;
  bool pictured_observations = false;  // See train::BudgetOptions.
};

// The map of a folder for browsers: fewer points, whose patches and descriptors come from fewer
// images. Poses are as good (docs/benchmarks.md).
MapBudget ForBrowsers(MapBudget budget);

struct ExportRequest {
  std::filesystem::path out;  // File of the bundle, or the folder for browsers.
  MapBudget budget = {};
  std::filesystem::path key = {};  // File of a secret key; empty: the bundle is not signed.
  // Folder of the page for browsers; empty: the one that comes with this program.
  std::filesystem::path page = {};
  std::string address = {};  // See exporter::WebExport.
  std::optional<bundle::FleetEntry> fleet = {};
};

// Bakes stale products, packs all places, the cast and the drama, and signs the bundle. On an error
// an existing bundle stays unchanged.
Status ExportProject(const ProjectPaths& paths,
                     const ProjectDocument& document,
                     const ExportRequest& request,
                     Progress& progress);

// Bakes stale products, and writes a folder for browsers, which has to be signed. On an error an
// existing folder stays unchanged.
Result<bundle::WebFolderReport> ExportProjectForWeb(const ProjectPaths& paths,
                                                    const ProjectDocument& document,
                                                    const ExportRequest& request,
                                                    Progress& progress);

// Bakes stale products, and publishes a bundle in the folder `out` (shared/bundle/publishing.h),
// which has to be signed. On an error the newest show of an existing folder stays as it was.
Result<bundle::Publication> PublishProject(const ProjectPaths& paths,
                                           const ProjectDocument& document,
                                           const ExportRequest& request,
                                           Progress& progress);

}  // namespace lararium::editor
