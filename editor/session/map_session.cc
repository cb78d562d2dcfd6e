#include "editor/session/map_session.h"

#include <algorithm>
#include <utility>

#include "editor/document/file_stamp.h"
#include "editor/jobs/occluder_alignment.h"
#include "editor/jobs/picked_frames.h"
#include "editor/jobs/previous_map.h"
#include "editor/jobs/training.h"
#include "editor/text/text.h"
#include "shared/core/file.h"

namespace lararium::editor {

namespace {

// Reads the report of a training; nullptr where there is none or it is damaged, which does not
// affect the map.
std::shared_ptr<const TrainingReport> ReadReport(const std::filesystem::path& file) {
  Result<TrainingReport> report = LoadTrainingReport(file);
  const bool known = report.ok() && !report->recording.empty();
  return known ? std::make_shared<const TrainingReport>(*std::move(report)) : nullptr;
}

std::string TagsKey(const PlaceDocument& place) {
  return place.tags ? place.tags->family + " " + std::to_string(place.tags->size_m) : "";
}

}  // namespace

MapSession::MapSession(ProjectSession& project, TaskList& tasks, MessageLog& messages, Log& log)
    : project_(project), tasks_(tasks), messages_(messages), log_(log) {
  project_.Subscribe([this](ProjectSession::Event event) {
    if (event == ProjectSession::Event::kPlaceSelected) {
      loaded_ = {};
      stale_ = true;
    } else if (event == ProjectSession::Event::kEdited) {
      UpdatePicks();
    }
  });
}

MapSession::~MapSession() {
  if (unsaved_ && FileStamp(unsaved_->file) == unsaved_->stamp) {
    const Status status = vision::SaveSceneDatabase(unsaved_->file, *unsaved_->database);
    if (!status.ok()) {
      log_.Error("{}", status.message());
    }
  }
}

void MapSession::Reload(const std::string& place) { stale_ |= place == project_.place_name(); }

void MapSession::DetectExternalChange() {
  stale_ |= loaded_.database != nullptr && !tasks_.Running(TaskKind::kTraining) &&
            !tasks_.Running(TaskKind::kOpening) && !unsaved() &&
            FileStamp(project_.paths().Scene(project_.place_name())) != stamp_;
}

void MapSession::UpdatePicks() {
  if (project_.place() == nullptr || loaded_.database == nullptr) {
    return;
  }
  measures_stale_ |= TagsKey(*project_.place()) != tags_key_;
  const std::string key = FormatPicks(project_.place()->picks).dump();
  if (key != picks_key_) {
    picks_key_ = key;
    loaded_.picks = ResolvePicks(*project_.place(), *loaded_.database, loaded_.measures);
    if (!loaded_.picks.problem.ok()) {
      messages_.Tell(Message::Level::kWarning, loaded_.picks.problem.message());
    }
  }
}

void MapSession::TakeMeasures(MapMeasures measures) {
  loaded_.measures = std::move(measures);
  loaded_.measured = true;
  picks_key_.clear();
  UpdatePicks();
  ++revision_;
}

void MapSession::Measure() {
  measures_stale_ = false;
  if (project_.place() == nullptr || loaded_.database == nullptr) {
    return;
  }
  const auto measures = std::make_shared<MapMeasures>();
  const auto work = [measures, place = *project_.place(),
                     database = loaded_.database](Progress& progress) {
    progress.Report("looking for the floor and for tags", 0.0);
    *measures = MeasureMap(place, *database);
    return Status();
  };
  const auto done = [this, measures, database = loaded_.database](const Status&, bool cancelled) {
    if (!cancelled && database == loaded_.database) {
      TakeMeasures(std::move(*measures));
    }
  };
  if (tasks_.Start(TaskKind::kMeasuring, work, done)) {
    tags_key_ = TagsKey(*project_.place());
    loaded_.measured = false;
  } else {
    measures_stale_ = true;  // Measure again after the running measurement.
  }
}

void MapSession::LayStageOnFloor() {
  if (!loaded_.measures.floor || project_.place() == nullptr) {
    return;
  }
  const geometry::Similarity3& now = project_.place()->picked_from_stage;
  const geometry::Similarity3 laid =
      LayOnFloor(loaded_.picks.map_from_picked, now, *loaded_.measures.floor);
  constexpr double kSame = 1e-7;  // Metres and radians.
  if ((laid.translation - now.translation).norm() > kSame ||
      laid.rotation.angularDistance(now.rotation) > kSame) {
    project_.EditPlace(Sentence("lay the stage on the floor"),
                       [&](PlaceDocument& edited) { edited.picked_from_stage = laid; });
  }
}

void MapSession::SetDistance(uint32_t from, uint32_t to, double metres) {
  if (project_.place() == nullptr || loaded_.database == nullptr || !(metres > 0.0)) {
    return;
  }
  const Eigen::Vector3d from_in_map = loaded_.database->points[from].cast<double>();
  const Eigen::Vector3d to_in_map = loaded_.database->points[to].cast<double>();
  const geometry::Similarity3& now = project_.place()->picked_from_stage;
  const geometry::Similarity3& map_from_picked = loaded_.picks.map_from_picked;
  const double said = StageDistance(map_from_picked * now, from_in_map, to_in_map);
  if (!(said > 0.0)) {
    return;
  }
  const geometry::Similarity3 scaled =
      ScaledToDistance(map_from_picked, now, from_in_map, to_in_map, metres);
  if (!(scaled.scale >= kMinStageScale && scaled.scale <= kMaxStageScale)) {
    messages_.Tell(Message::Level::kError,
                   Tr("The stage was left as it is: by that distance it would be "
                      "impossibly large or small."));
    return;
  }
  project_.EditPlace(Sentence("scale the stage"),
                     [&](PlaceDocument& edited) { edited.picked_from_stage = scaled; });
  messages_.Tell(
      Message::Level::kInfo,
      Text(Tr("The stage was scaled: its metres said %.3f m where %.3f m were typed (%+.2f %%)."),
           said, metres, 100.0 * (said / metres - 1.0)));
}

void MapSession::Read() {
  if (unsaved()) {
    return;  // Update() tries again.
  }
  const std::filesystem::path file = project_.paths().Scene(project_.place_name());
  if (project_.place() == nullptr || !FileExists(file)) {
    stale_ = false;
    return;
  }
  const auto loaded = std::make_shared<LoadedMap>();
  const auto work = [=, place = *project_.place(), paths = project_.paths()](Progress& progress) {
    progress.Report("reading the map", 0.0);
    loaded->report = ReadReport(CurrentMap(paths, place.name).report);
    loaded->warnings = MapWarnings(paths, place.name);
    LARARIUM_ASSIGN_OR_RETURN(vision::SceneDatabase database, vision::LoadSceneDatabase(file));
    progress.Report("looking for the floor and for tags", 0.5);
    loaded->measures = MeasureMap(place, database);
    loaded->statistics =
        std::make_shared<const train::MapStatistics>(train::MeasureStatistics(database));
    loaded->database = std::make_shared<const vision::SceneDatabase>(std::move(database));
    loaded->has_previous = HasPreviousMap(paths, place.name);
    return Status();
  };
  const auto done = [this, loaded, name = project_.place_name(), key = TagsKey(*project_.place()),
                     stamp = FileStamp(file)](const Status& status, bool cancelled) {
    if (!status.ok()) {
      messages_.Report(status, cancelled, "");
    } else if (name == project_.place_name()) {
      loaded_ = std::move(*loaded);
      stamp_ = stamp;
      ++loads_;
      tags_key_ = key;
      TakeMeasures(std::move(loaded_.measures));
    }
  };
  // Another place is being opened; Update() tries again.
  stale_ = !tasks_.Start(TaskKind::kOpening, work, done);
}

void MapSession::KeepFrame(const vision::Keyframe& keyframe) {
  auto database = WithFrame(loaded_.database, keyframe);
  if (database == loaded_.database) {
    return;
  }
  // A running measurement is of the old map.
  measures_stale_ |= tasks_.Running(TaskKind::kMeasuring);
  loaded_.database = std::move(database);
  auto statistics = std::make_shared<train::MapStatistics>(*loaded_.statistics);
  train::AddUnobserved(keyframe.session, *statistics);
  loaded_.statistics = std::move(statistics);
  picks_key_.clear();
  UpdatePicks();
  unsaved_ = {project_.paths().Scene(project_.place_name()), stamp_, loaded_.database};
}

void MapSession::Write() {
  if (FileStamp(unsaved_->file) != unsaved_->stamp) {
    unsaved_.reset();  // The map was trained again; the new one is read instead.
    return;
  }
  const auto work = [map = *unsaved_](Progress&) {
    return vision::SaveSceneDatabase(map.file, *map.database);
  };
  const auto done = [this, file = unsaved_->file](const Status& status, bool) {
    messages_.TellFailure(status);
    if (file == project_.paths().Scene(project_.place_name())) {
      stamp_ = FileStamp(file);
    }
  };
  if (tasks_.Start(TaskKind::kWritingMap, work, done)) {
    unsaved_.reset();
  }
}

void MapSession::RefineOccluder(const std::string& name,
                                std::shared_ptr<const stage::Place> staged,
                                double search_m) {
  const OccluderDocument* occluder =
      project_.place() == nullptr ? nullptr : project_.place()->FindOccluder(name);
  if (occluder == nullptr || loaded_.database == nullptr || staged == nullptr) {
    return;
  }
  const auto solid = std::find_if(staged->occluders.begin(), staged->occluders.end(),
                                  [&](const stage::Occluder& o) { return o.name == name; });
  if (solid == staged->occluders.end()) {
    return;
  }
  using Outcome = Result<train::RefineReport>;
  const auto outcome = std::make_shared<Outcome>(Status::Error(name, "was not refined"));
  const auto work = [=, staged = std::move(staged), document = *occluder, map = loaded_.database,
                     map_from_stage = loaded_.picks.map_from_picked *
                                      project_.place()->picked_from_stage](Progress& progress) {
    *outcome = RefineOnMap(document, solid->mesh, *map, map_from_stage, search_m, progress);
    return outcome->status();
  };
  const auto done = [this, outcome, name, place = project_.place_name(),
                     start = occluder->stage_from_mesh](const Status& status, bool cancelled) {
    const bool found = status.ok() && !cancelled;
    messages_.Report(status, cancelled, found ? name + ": " + RefineText(**outcome, true) : "");
    if (cancelled) {
      return;
    }
    refinement_ = {place, name, found ? (*outcome)->stage_from_mesh : start, *outcome};
    const PlaceDocument* at = project_.document().FindPlace(place);
    const OccluderDocument* now = at == nullptr ? nullptr : at->FindOccluder(name);
    if (found && now != nullptr && now->stage_from_mesh == start) {
      project_.Edit(Sentence("refine %s", {name}), [&](ProjectDocument& document) {
        document.FindPlace(place)->FindOccluder(name)->stage_from_mesh =
            refinement_->stage_from_mesh;
      });
    }
  };
  tasks_.Start(TaskKind::kRefining, work, done);
}

const MapSession::Refinement* MapSession::refinement(const OccluderDocument& occluder) const {
  const bool applies = refinement_ && refinement_->place == project_.place_name() &&
                       refinement_->occluder == occluder.name &&
                       refinement_->stage_from_mesh == occluder.stage_from_mesh;
  return applies ? &*refinement_ : nullptr;
}

void MapSession::Update() {
  if (unsaved_ && !tasks_.Running(TaskKind::kWritingMap) && !tasks_.Running(TaskKind::kTraining)) {
    Write();
  }
  if (stale_) {
    Read();
  }
  if (measures_stale_) {
    Measure();
  }
}

}  // namespace lararium::editor
