#include "editor/jobs/previous_map.h"

#include <system_error>

#include "editor/jobs/training_report.h"
#include "shared/core/file.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

Status Problem(const fs::path& file, const char* what, const std::error_code& error) {
  return Status::Error(file.string(), std::string(what) + ": " + error.message(),
                       "make room on the disk, or check who may write to the folder");
}

// Gives a file a second name, replacing a file that has it. If the file is replaced later, the
// second name still has the old content.
Status Alias(const fs::path& file, const fs::path& alias) {
  const fs::path fresh = alias.string() + ".new";
  std::error_code error;
  fs::remove(fresh, error);
  fs::create_hard_link(file, fresh, error);
  if (error) {  // Not every file system supports links.
    fs::copy_file(file, fresh, error);
  }
  if (!error) {
    fs::rename(fresh, alias, error);
  }
  return error ? Problem(alias, "cannot be written", error) : Status();
}

// Exchanges two files. At every moment the first name has a file.
Status Exchange(const fs::path& file, const fs::path& other) {
  const fs::path aside = other.string() + ".aside";
  LARARIUM_RETURN_IF_ERROR(Alias(file, aside));
  std::error_code error;
  fs::rename(other, file, error);
  if (!error) {
    fs::rename(aside, other, error);
  }
  return error ? Problem(file, "cannot be exchanged with the former map", error) : Status();
}

// Writes a report for a map whose report was deleted. It contains only what the project knows.
Status MakeReport(const fs::path& file, const PlaceDocument& place) {
  if (FileExists(file)) {
    return Status();
  }
  TrainingReport report;
  report.recordings = RecordingsOf(place);
  return SaveTrainingReport(file, report);
}

}  // namespace

MapFiles CurrentMap(const ProjectPaths& paths, const std::string& place) {
  return {paths.Scene(place), paths.Place(place) / "training.json"};
}

MapFiles PreviousMap(const ProjectPaths& paths, const std::string& place) {
  return {paths.Place(place) / "former.larscene", paths.Place(place) / "former-training.json"};
}

Status KeepPreviousMap(const ProjectPaths& paths, const PlaceDocument& place) {
  const MapFiles map = CurrentMap(paths, place.name);
  const MapFiles former = PreviousMap(paths, place.name);
  if (!FileExists(map.scene)) {
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR(MakeReport(map.report, place));
  LARARIUM_RETURN_IF_ERROR(Alias(map.scene, former.scene));
  return Alias(map.report, former.report);
}

bool HasPreviousMap(const ProjectPaths& paths, const std::string& place) {
  const MapFiles former = PreviousMap(paths, place);
  return FileExists(former.scene) && FileExists(former.report);
}

Result<PlaceRecordings> RestorePreviousMap(const ProjectPaths& paths, const PlaceDocument& place) {
  if (!HasPreviousMap(paths, place.name)) {
    return Status::Error(place.name, "has no former map",
                         "one is kept whenever a trained place is trained again");
  }
  const MapFiles map = CurrentMap(paths, place.name);
  const MapFiles former = PreviousMap(paths, place.name);
  LARARIUM_ASSIGN_OR_RETURN(const TrainingReport report, LoadTrainingReport(former.report));
  const size_t sessions = 1 + report.recordings.added.size();
  if (const size_t picks = PicksInSessionsFrom(place, static_cast<uint32_t>(sessions)); picks > 0) {
    return Status::Error(place.name,
                         "picked points lie in images that the former map does not have (" +
                             std::to_string(picks) + ")",
                         "take these picks away first");
  }
  LARARIUM_RETURN_IF_ERROR(MakeReport(map.report, place));
  LARARIUM_RETURN_IF_ERROR(Exchange(map.report, former.report));
  LARARIUM_RETURN_IF_ERROR(Exchange(map.scene, former.scene));
  return report.recordings;
}

Status ForgetPreviousMap(const ProjectPaths& paths, const std::string& place) {
  const MapFiles former = PreviousMap(paths, place);
  for (const fs::path& file : {former.scene, former.report}) {
    std::error_code error;
    fs::remove(file, error);
    if (error) {
      return Problem(file, "cannot be removed", error);
    }
  }
  return Status();
}

}  // namespace lararium::editor
