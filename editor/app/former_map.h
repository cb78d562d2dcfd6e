#pragma once

// The map that a training replaces stays beside the new one until the next training, so that it
// can be put back.

#include <filesystem>
#include <string>

#include "editor/app/place_recordings.h"
#include "editor/app/project.h"
#include "shared/core/status.h"

namespace lararium::app {

// A map and the report of its training (training_report.h).
struct MapFiles {
  std::filesystem::path scene;
  std::filesystem::path report;
};
MapFiles MapAtHand(const ProjectPaths& paths, const std::string& place);
MapFiles FormerMap(const ProjectPaths& paths, const std::string& place);

// Before a map is replaced: keeps it, with its report, in place of the one that was kept before.
// The map at hand stays where it is, whenever this is interrupted. Nothing where there is none yet.
Status KeepFormerMap(const ProjectPaths& paths, const PlaceDocument& place);

bool HasFormerMap(const ProjectPaths& paths, const std::string& place);

// Exchanges the map at hand with the one that was kept, so that doing it again undoes it, and
// gives what that one is made of. An error where none was kept, or something was picked in images
// that it has not.
Result<PlaceRecordings> PutFormerMapBack(const ProjectPaths& paths, const PlaceDocument& place);

// The map has lost what the former one still has, and what was picked there is forgotten.
Status ForgetFormerMap(const ProjectPaths& paths, const std::string& place);

}  // namespace lararium::app
