#pragma once

// The map that a training replaces stays beside the new one until the next training, so that it can
// be restored.

#include <filesystem>
#include <string>

#include "editor/document/place_recordings.h"
#include "editor/document/project.h"
#include "shared/core/status.h"

namespace lararium::editor {

// The files of a map and of the report on its training (training_report.h).
struct MapFiles {
  std::filesystem::path scene;
  std::filesystem::path report;
};
MapFiles CurrentMap(const ProjectPaths& paths, const std::string& place);
MapFiles PreviousMap(const ProjectPaths& paths, const std::string& place);

// Keeps the current map and its report as the previous map, replacing an older one. Call before a
// training writes a new map. The current map stays valid even when this is interrupted. Does
// nothing where the place has no map.
Status KeepPreviousMap(const ProjectPaths& paths, const PlaceDocument& place);

bool HasPreviousMap(const ProjectPaths& paths, const std::string& place);

// Exchanges the current map with the previous one, so that a second call undoes it. Returns the
// recordings of the restored map. Fails where there is no previous map, or where picks lie in
// images that it does not have.
Result<PlaceRecordings> RestorePreviousMap(const ProjectPaths& paths, const PlaceDocument& place);

// Deletes the previous map, for a session that is removed: the previous map would still contain it,
// but its picks are gone.
Status ForgetPreviousMap(const ProjectPaths& paths, const std::string& place);

}  // namespace lararium::editor
