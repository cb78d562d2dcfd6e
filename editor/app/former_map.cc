#include "editor/app/former_map.h"

#include <system_error>

#include "editor/app/training_report.h"

namespace lararium::app {

namespace {

namespace fs = std::filesystem;

Status Problem(const fs::path& file, const char* what, const std::error_code& error) {
  return Status::Error(file.string(), std::string(what) + ": " + error.message(),
                       "make room on the disk, or look who may write there");
}

// Another name for a file, in place of what has that name. What replaces the file later leaves it.
Status Alias(const fs::path& file, const fs::path& alias) {
  const fs::path fresh = alias.string() + ".new";
  std::error_code error;
  fs::remove(fresh, error);
  fs::create_hard_link(file, fresh, error);
  if (error) {  // not every disk has links
    fs::copy_file(file, fresh, error);
  }
  if (!error) {
    fs::rename(fresh, alias, error);
  }
  return error ? Problem(alias, "cannot be written", error) : Status();
}

// Each file goes where the other one was; there is always one where the first was.
Status Exchange(const fs::path& file, const fs::path& other) {
  const fs::path aside = other.string() + ".aside";
  LARARIUM_RETURN_IF_ERROR(Alias(file, aside));
  std::error_code error;
  fs::rename(other, file, error);
  if (!error) {
    fs::rename(aside, other, error);
  }
  return error ? Problem(file, "cannot be exchanged with the former one", error) : Status();
}

// Maps from before there were reports: nothing is known but what the project says.
Status MakeReport(const fs::path& file, const PlaceDocument& place) {
  std::error_code ignored;
  if (fs::exists(file, ignored)) {
    return Status();
  }
  TrainingReport report;
  report.recordings = RecordingsOf(place);
  return SaveTrainingReport(file, report);
}

}  // namespace

MapFiles MapAtHand(const ProjectPaths& paths, const std::string& place) {
  return {paths.Scene(place), paths.Place(place) / "training.json"};
}

MapFiles FormerMap(const ProjectPaths& paths, const std::string& place) {
  return {paths.Place(place) / "former.larscene", paths.Place(place) / "former-training.json"};
}

Status KeepFormerMap(const ProjectPaths& paths, const PlaceDocument& place) {
  const MapFiles map = MapAtHand(paths, place.name);
  const MapFiles former = FormerMap(paths, place.name);
  std::error_code ignored;
  if (!fs::exists(map.scene, ignored)) {
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR(MakeReport(map.report, place));
  LARARIUM_RETURN_IF_ERROR(Alias(map.scene, former.scene));
  return Alias(map.report, former.report);
}

bool HasFormerMap(const ProjectPaths& paths, const std::string& place) {
  const MapFiles former = FormerMap(paths, place);
  std::error_code ignored;
  return fs::exists(former.scene, ignored) && fs::exists(former.report, ignored);
}

Result<PlaceRecordings> PutFormerMapBack(const ProjectPaths& paths, const PlaceDocument& place) {
  if (!HasFormerMap(paths, place.name)) {
    return Status::Error(place.name, "has no former map",
                         "one is kept whenever a trained place is trained again");
  }
  const MapFiles map = MapAtHand(paths, place.name);
  const MapFiles former = FormerMap(paths, place.name);
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

Status ForgetFormerMap(const ProjectPaths& paths, const std::string& place) {
  const MapFiles former = FormerMap(paths, place);
  for (const fs::path& file : {former.scene, former.report}) {
    std::error_code error;
    fs::remove(file, error);
    if (error) {
      return Problem(file, "cannot be removed", error);
    }
  }
  return Status();
}

}  // namespace lararium::app
