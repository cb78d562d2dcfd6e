#include <algorithm>
#include <utility>

#include "editor/document/file_stamp.h"
#include "editor/jobs/camera_measure.h"
#include "editor/jobs/occluder_alignment.h"
#include "editor/jobs/previous_map.h"
#include "editor/jobs/training.h"
#include "editor/session/workspace.h"

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

void Workspace::ResolvePicksAgain() {
  if (place() == nullptr || loaded_.database == nullptr) {
    return;
  }
  measures_stale_ |= TagsKey(*place()) != tags_key_;
  const std::string key = FormatPicks(place()->picks).dump();
  if (key != picks_key_) {
    picks_key_ = key;
    loaded_.picks = ResolvePicks(*place(), *loaded_.database, loaded_.measures);
    if (!loaded_.picks.problem.ok()) {
      Tell(Message::Level::kWarning, loaded_.picks.problem.message());
    }
  }
}

void Workspace::MeasureAgain() {
  measures_stale_ = false;
  if (place() == nullptr || loaded_.database == nullptr) {
    return;
  }
  const auto measures = std::make_shared<MapMeasures>();
  const auto work = [measures, place = *place(), database = loaded_.database](Progress& progress) {
    progress.Report("looking for the floor and for tags", 0.0);
    *measures = MeasureMap(place, *database);
    return Status();
  };
  const auto done = [this, measures, database = loaded_.database](const Status&, bool cancelled) {
    if (!cancelled && database == loaded_.database) {
      loaded_.measures = std::move(*measures);
      loaded_.measured = true;
      picks_key_.clear();
      ResolvePicksAgain();
      place_changed_ = true;
    }
  };
  if (tasks_.Start(TaskKind::kMeasuring, work, done)) {
    tags_key_ = TagsKey(*place());
    loaded_.measured = false;
  } else {
    measures_stale_ = true;  // Measure again after the running measurement.
  }
}

void Workspace::LayStageOnFloor() {
  if (!loaded_.measures.floor || place() == nullptr) {
    return;
  }
  const geometry::Similarity3& now = place()->picked_from_stage;
  const geometry::Similarity3 laid =
      LayOnFloor(loaded_.picks.map_from_picked, now, *loaded_.measures.floor);
  constexpr double kSame = 1e-7;  // Metres and radians.
  if ((laid.translation - now.translation).norm() > kSame ||
      laid.rotation.angularDistance(now.rotation) > kSame) {
    EditPlace(Tr("lay the stage on the floor"),
              [&](PlaceDocument& edited) { edited.picked_from_stage = laid; });
  }
}

void Workspace::SetDistance(uint32_t from, uint32_t to, double metres) {
  if (place() == nullptr || loaded_.database == nullptr || !(metres > 0.0)) {
    return;
  }
  const Eigen::Vector3d from_in_map = loaded_.database->points[from].cast<double>();
  const Eigen::Vector3d to_in_map = loaded_.database->points[to].cast<double>();
  const geometry::Similarity3& now = place()->picked_from_stage;
  const geometry::Similarity3& map_from_picked = loaded_.picks.map_from_picked;
  const double said = StageDistance(map_from_picked * now, from_in_map, to_in_map);
  if (!(said > 0.0)) {
    return;
  }
  const geometry::Similarity3 scaled =
      ScaledToDistance(map_from_picked, now, from_in_map, to_in_map, metres);
  if (!(scaled.scale >= kMinStageScale && scaled.scale <= kMaxStageScale)) {
    Tell(Message::Level::kError, Tr("The stage was left as it is: by that distance it would be "
                                    "impossibly large or small."));
    return;
  }
  EditPlace(Tr("scale the stage"),
            [&](PlaceDocument& edited) { edited.picked_from_stage = scaled; });
  Tell(Message::Level::kInfo,
       Text(Tr("The stage was scaled: its metres said %.3f m where %.3f m were typed (%+.2f %%)."),
            said, metres, 100.0 * (said / metres - 1.0)));
}

void Workspace::ReloadMap() {
  if (unsaved_map_ || tasks_.Running(TaskKind::kWritingMap)) {
    return;  // Update() tries again.
  }
  const std::filesystem::path file = paths_.Scene(place_name_);
  std::error_code ignored;
  if (place() == nullptr || !std::filesystem::exists(file, ignored)) {
    map_stale_ = false;
    return;
  }
  using Database = std::shared_ptr<const vision::SceneDatabase>;
  const auto loaded = std::make_shared<Database>();
  const auto measures = std::make_shared<MapMeasures>();
  const auto statistics = std::make_shared<train::MapStatistics>();
  const auto report = std::make_shared<std::shared_ptr<const TrainingReport>>();
  const auto work = [=, place = *place(), paths = paths_](Progress& progress) {
    progress.Report("reading the map", 0.0);
    *report = ReadReport(CurrentMap(paths, place.name).report);
    LARARIUM_ASSIGN_OR_RETURN(vision::SceneDatabase database, vision::LoadSceneDatabase(file));
    progress.Report("looking for the floor and for tags", 0.5);
    *measures = MeasureMap(place, database);
    *statistics = train::MeasureStatistics(database);
    *loaded = std::make_shared<const vision::SceneDatabase>(std::move(database));
    return Status();
  };
  const auto done = [this, loaded, measures, statistics, report, name = place_name_,
                     key = TagsKey(*place()),
                     stamp = FileStamp(file)](const Status& status, bool cancelled) {
    if (!status.ok()) {
      Report(status, cancelled, "");
    } else if (name == place_name_) {
      loaded_.database = *loaded;
      scene_stamp_ = stamp;
      ++map_loads_;
      loaded_.statistics = statistics;
      loaded_.report = *report;
      loaded_.has_previous = HasPreviousMap(paths_, name);
      if (*report != nullptr && trained_place_ == name) {
        trained_place_.clear();
        report_is_new_ = true;
      }
      loaded_.measures = std::move(*measures);
      loaded_.measured = true;
      tags_key_ = key;
      picks_key_.clear();
      ResolvePicksAgain();
      preview_key_.clear();
      preview_stale_ = true;
    }
  };
  // Another place is being opened; Update() tries again.
  map_stale_ = !tasks_.Start(TaskKind::kOpening, work, done);
}

FrameToPick Workspace::frame_to_pick() const {
  if (picture_ == nullptr || loaded_.database == nullptr) {
    return {std::nullopt, TrLater("There is no picture yet")};
  }
  if (view_source_ == ViewSource::kLive) {
    return {std::nullopt, TrLater("A live camera's images pass: pick in the training recording")};
  }
  if (picture_->frame != frame()) {
    return {std::nullopt, TrLater("The picture of this frame is on its way")};
  }
  if (tasks_.Running(TaskKind::kTraining)) {
    return {std::nullopt, TrLater("The place is being trained: pick when that is done")};
  }
  return FindFrameToPick(*picture_, *loaded_.database,
                         view_source_ == ViewSource::kTraining || !has_own_recording());
}

void Workspace::KeepFrame(const vision::Keyframe& keyframe) {
  auto database = WithFrame(loaded_.database, keyframe);
  if (database == loaded_.database) {
    return;
  }
  measures_stale_ |=
      tasks_.Running(TaskKind::kMeasuring);  // The running measurement is of the old map.
  loaded_.database = std::move(database);
  auto statistics = std::make_shared<train::MapStatistics>(*loaded_.statistics);
  train::AddUnobserved(keyframe.session, *statistics);
  loaded_.statistics = std::move(statistics);
  picks_key_.clear();
  ResolvePicksAgain();
  unsaved_map_ = {paths_.Scene(place_name_), scene_stamp_, loaded_.database};
}

void Workspace::WriteMap() {
  if (FileStamp(unsaved_map_->file) != unsaved_map_->stamp) {
    unsaved_map_.reset();  // The map was trained again; the new one is read instead.
    return;
  }
  const auto work = [map = *unsaved_map_](Progress&) {
    return vision::SaveSceneDatabase(map.file, *map.database);
  };
  const auto done = [this, file = unsaved_map_->file](const Status& status, bool) {
    if (!status.ok()) {
      Tell(Message::Level::kError, status.message());
    }
    if (file == paths_.Scene(place_name_)) {
      scene_stamp_ = FileStamp(file);
    }
  };
  if (tasks_.Start(TaskKind::kWritingMap, work, done)) {
    unsaved_map_.reset();
  }
}

void Workspace::MeasureCameraTraits() {
  if (place() == nullptr) {
    return;
  }
  const auto traits = std::make_shared<light::CameraTraits>();
  tasks_.Start(
      TaskKind::kCamera,
      [traits, paths = paths_, place = *place()](Progress& progress) {
        LARARIUM_ASSIGN_OR_RETURN(*traits, MeasureCamera(paths, place, progress));
        return Status();
      },
      [this, traits, name = place_name_](const Status& status, bool cancelled) {
        Report(status, cancelled, name + ": " + CameraText(*traits));
        if (status.ok() && !cancelled) {
          Edit(Tr("measure the camera"), [&](ProjectDocument& document) {
            if (PlaceDocument* place = document.FindPlace(name)) {
              place->camera = *traits;
            }
          });
        }
      });
}

void Workspace::RefineOccluder(const std::string& name, double search_m) {
  const std::shared_ptr<const stage::Place> staged = loaded_.staged;
  const OccluderDocument* occluder = place() == nullptr ? nullptr : place()->FindOccluder(name);
  if (occluder == nullptr || loaded_.database == nullptr || staged == nullptr) {
    return;
  }
  const auto solid =
      static_cast<size_t>(std::find_if(staged->occluders.begin(), staged->occluders.end(),
                                       [&](const stage::Occluder& o) { return o.name == name; }) -
                          staged->occluders.begin());
  if (solid == staged->occluders.size()) {
    return;
  }
  using Outcome = Result<train::RefineReport>;
  const auto outcome = std::make_shared<Outcome>(Status::Error(name, "was not refined"));
  const auto work = [=, document = *occluder, map = loaded_.database,
                     map_from_stage = loaded_.picks.map_from_picked *
                                      place()->picked_from_stage](Progress& progress) {
    *outcome = RefineOnMap(document, staged->occluders[solid].mesh, *map, map_from_stage, search_m,
                           progress);
    return outcome->status();
  };
  const auto done = [this, outcome, name, place = place_name_, start = occluder->stage_from_mesh](
                        const Status& status, bool cancelled) {
    const bool found = status.ok() && !cancelled;
    Report(status, cancelled, found ? name + ": " + RefineText(**outcome, true) : "");
    if (cancelled) {
      return;
    }
    refinement_ = {place, name, found ? (*outcome)->stage_from_mesh : start, *outcome};
    const PlaceDocument* at = document().FindPlace(place);
    const OccluderDocument* now = at == nullptr ? nullptr : at->FindOccluder(name);
    if (found && now != nullptr && now->stage_from_mesh == start) {
      Edit(Text(Tr("refine %s"), name.c_str()), [&](ProjectDocument& document) {
        document.FindPlace(place)->FindOccluder(name)->stage_from_mesh =
            refinement_->stage_from_mesh;
      });
    }
  };
  tasks_.Start(TaskKind::kRefining, work, done);
}

const Workspace::Refinement* Workspace::refinement(const OccluderDocument& occluder) const {
  const bool applies = refinement_ && refinement_->place == place_name_ &&
                       refinement_->occluder == occluder.name &&
                       refinement_->stage_from_mesh == occluder.stage_from_mesh;
  return applies ? &*refinement_ : nullptr;
}

void Workspace::NameRecordings(const std::string& name, const PlaceRecordings& recordings) {
  map_stale_ |= name == place_name_;
  const PlaceDocument* now = document().FindPlace(name);
  if (now != nullptr && FormatRecordings(RecordingsOf(*now)) == FormatRecordings(recordings)) {
    return;
  }
  commands_.Rewrite([&](ProjectDocument& document) {
    if (PlaceDocument* place = document.FindPlace(name)) {
      SetRecordings(recordings, *place);
    }
  });
  OnDocumentChanged();
}

void Workspace::StartTraining(std::function<Result<train::TrainReport>(Progress&)> work,
                              std::vector<TaskStep> steps,
                              const PlaceRecordings& recordings) {
  const auto report = std::make_shared<train::TrainReport>();
  const bool started = tasks_.Start(
      TaskKind::kTraining,
      [report, work = std::move(work)](Progress& progress) {
        LARARIUM_ASSIGN_OR_RETURN(*report, work(progress));
        return Status();
      },
      [this, report, name = place_name_, recordings](const Status& status, bool cancelled) {
        // A cancellation after the map was written has no effect.
        Report(status, cancelled && !status.ok(),
               Text(Tr("%s: %d of %d images located, %d points."), name.c_str(),
                    static_cast<int>(report->located.size()), report->frames,
                    static_cast<int>(report->points)));
        if (status.ok()) {
          trained_place_ = name;
          NameRecordings(name, recordings);
        }
      },
      std::move(steps));
  if (!started) {
    Tell(Message::Level::kWarning, Tr("A training is running already. Cancel it first."));
  }
}

void Workspace::TrainWith(const PlaceRecordings& recordings) {
  PlaceDocument trained = *place();
  SetRecordings(recordings, trained);
  StartTraining([paths = paths_, trained, &log = log_](
                    Progress& progress) { return TrainPlace(paths, trained, {}, progress, log); },
                TrainingSteps(trained.added.size()), recordings);
}

void Workspace::Train() {
  if (place() != nullptr) {
    TrainWith(RecordingsOf(*place()));
  }
}

void Workspace::TrainFrom(const std::string& name, const SessionDocument& recording) {
  std::error_code ignored;
  const bool has_map =
      document().FindPlace(name) != nullptr && std::filesystem::exists(paths_.Scene(name), ignored);
  if (!has_map) {
    Edit(Text(Tr("train %s"), name.c_str()), [&](ProjectDocument& document) {
      PlaceDocument* place = document.FindPlace(name);
      if (place == nullptr) {
        place = &document.places.emplace_back();
        place->name = name;
      }
      place->training = recording.source;
      place->intrinsics = recording.intrinsics;
    });
  }
  if (place() == nullptr || place()->name != name) {
    SelectPlace(name);
  }
  PlaceRecordings recordings = RecordingsOf(*place());
  recordings.training = recording.source;
  recordings.intrinsics = recording.intrinsics;
  TrainWith(recordings);
}

void Workspace::AddSession(const SessionDocument& session) {
  if (place() == nullptr) {
    return;
  }
  PlaceRecordings recordings = RecordingsOf(*place());
  recordings.added.push_back(session);
  StartTraining(
      [paths = paths_, place = *place(), session, &log = log_](Progress& progress) {
        return TrainSession(paths, place, session, {}, progress, log);
      },
      SessionSteps(), recordings);
}

void Workspace::RemoveSession(uint32_t session) {
  if (place() == nullptr || session == 0 || session > place()->added.size()) {
    return;
  }
  if (!MapIsFree()) {
    return;
  }
  const auto removed = std::make_shared<train::RemovedSession>();
  const auto work = [removed, paths = paths_, place = *place(), session](Progress& progress) {
    LARARIUM_ASSIGN_OR_RETURN(*removed, RemoveFromMap(paths, place, session, progress));
    return Status();
  };
  const auto done = [this, removed, session, name = place_name_](const Status& status,
                                                                 bool cancelled) {
    Report(status, cancelled,
           Text(Tr("%s: a session was removed, with %d keyframes and %d points."), name.c_str(),
                static_cast<int>(removed->keyframes), static_cast<int>(removed->points)));
    if (!status.ok()) {
      return;
    }
    commands_.Rewrite([&](ProjectDocument& document) {
      if (PlaceDocument* place = document.FindPlace(name)) {
        ForgetSession(*place, session);
      }
    });
    map_stale_ |= name == place_name_;
    OnDocumentChanged();
  };
  tasks_.Start(TaskKind::kTraining, work, done);
}

bool Workspace::MapIsFree() {
  if (tasks_.Running(TaskKind::kTraining)) {
    Tell(Message::Level::kWarning, Tr("A training is running already. Cancel it first."));
    return false;
  }
  // Writing them would restore the recording that is removed.
  if (unsaved_map_ || tasks_.Running(TaskKind::kWritingMap)) {
    Tell(Message::Level::kWarning, Tr("The map is being written. Try again in a moment."));
    return false;
  }
  return true;
}

void Workspace::RestorePreviousMap() {
  if (place() == nullptr || !MapIsFree()) {
    return;
  }
  const Result<PlaceRecordings> recordings = editor::RestorePreviousMap(paths_, *place());
  if (!recordings.ok()) {
    Tell(Message::Level::kError, recordings.message());
    return;
  }
  NameRecordings(place_name_, *recordings);
  Tell(Message::Level::kInfo,
       Text(Tr("%s: the other map is in use. Doing so again changes back."), place_name_.c_str()));
}

}  // namespace lararium::editor
