#include "editor/session/map_training.h"

#include <system_error>
#include <utility>

#include "editor/document/titles.h"
#include "editor/jobs/previous_map.h"
#include "editor/jobs/training.h"
#include "editor/text/text.h"
#include "shared/core/file.h"

namespace lararium::editor {

void MapTraining::NameRecordings(const std::string& name, const PlaceRecordings& recordings) {
  map_.Reload(name);
  const PlaceDocument* now = project_.document().FindPlace(name);
  if (now != nullptr && FormatFields(RecordingsOf(*now)) == FormatFields(recordings)) {
    return;
  }
  project_.Rewrite([&](ProjectDocument& document) {
    if (PlaceDocument* place = document.FindPlace(name)) {
      SetRecordings(recordings, *place);
    }
  });
}

void MapTraining::Start(std::function<Result<train::TrainReport>(Progress&)> work,
                        std::vector<TaskStep> steps,
                        const PlaceRecordings& recordings) {
  const auto report = std::make_shared<train::TrainReport>();
  const bool started = tasks_.Start(
      TaskKind::kTraining,
      [report, work = std::move(work)](Progress& progress) {
        LARARIUM_ASSIGN_OR_RETURN(*report, work(progress));
        return Status();
      },
      [this, report, name = project_.place_name(), recordings](const Status& status,
                                                               bool cancelled) {
        // A cancellation after the map was written has no effect.
        messages_.Report(status, cancelled && !status.ok(),
                         Text(Tr("%s: %d of %d images located, %d points."), name.c_str(),
                              static_cast<int>(report->located.size()), report->frames,
                              static_cast<int>(report->points)));
        for (const std::string& note : report->notes) {
          messages_.Warn(note);
        }
        if (status.ok()) {
          trained_place_ = name;
          loads_before_ = map_.loads();
          NameRecordings(name, recordings);
        }
      },
      std::move(steps));
  if (!started) {
    messages_.Tell(Message::Level::kWarning, Tr("A training is running already. Cancel it first."));
  }
}

void MapTraining::TrainWith(const PlaceRecordings& recordings) {
  PlaceDocument trained = *project_.place();
  SetRecordings(recordings, trained);
  Start([paths = project_.paths(), trained,
         &log = log_](Progress& progress) { return TrainPlace(paths, trained, {}, progress, log); },
        TrainingSteps(trained.added.size()), recordings);
}

void MapTraining::Train() {
  if (project_.place() != nullptr) {
    TrainWith(RecordingsOf(*project_.place()));
  }
}

void MapTraining::TrainFrom(const std::string& name,
                            const std::string& title,
                            const SessionDocument& recording) {
  const bool has_map =
      project_.document().FindPlace(name) != nullptr && FileExists(project_.paths().Scene(name));
  if (!has_map) {
    project_.Edit(Sentence("train %s", {title}), [&](ProjectDocument& document) {
      PlaceDocument* place = document.FindPlace(name);
      if (place == nullptr) {
        place = &document.places.emplace_back();
        place->name = name;
        SetTitle(title, *place);
      }
      place->training = recording.source;
      place->intrinsics = recording.intrinsics;
    });
  }
  if (project_.place() == nullptr || project_.place()->name != name) {
    project_.SelectPlace(name);
  }
  PlaceRecordings recordings = RecordingsOf(*project_.place());
  recordings.training = recording.source;
  recordings.intrinsics = recording.intrinsics;
  TrainWith(recordings);
}

void MapTraining::AddSession(const SessionDocument& session) {
  if (project_.place() == nullptr) {
    return;
  }
  PlaceRecordings recordings = RecordingsOf(*project_.place());
  recordings.added.push_back(session);
  Start([paths = project_.paths(), place = *project_.place(), session, &log = log_](
            Progress& progress) { return TrainSession(paths, place, session, {}, progress, log); },
        SessionSteps(), recordings);
}

void MapTraining::RemoveSession(uint32_t session) {
  if (project_.place() == nullptr || session == 0 || session > project_.place()->added.size() ||
      !MapIsFree()) {
    return;
  }
  const auto removed = std::make_shared<train::RemovedSession>();
  const auto work = [removed, paths = project_.paths(), place = *project_.place(),
                     session](Progress& progress) {
    LARARIUM_ASSIGN_OR_RETURN(*removed, RemoveFromMap(paths, place, session, progress));
    return Status();
  };
  const auto done = [this, removed, session, name = project_.place_name()](const Status& status,
                                                                           bool cancelled) {
    messages_.Report(
        status, cancelled,
        Text(Tr("%s: a session was removed, with %d keyframes and %d points."), name.c_str(),
             static_cast<int>(removed->keyframes), static_cast<int>(removed->points)));
    if (!status.ok()) {
      return;
    }
    project_.Rewrite([&](ProjectDocument& document) {
      if (PlaceDocument* place = document.FindPlace(name)) {
        ForgetSession(*place, session);
      }
    });
    map_.Reload(name);
  };
  tasks_.Start(TaskKind::kTraining, work, done);
}

bool MapTraining::MapIsFree() {
  if (tasks_.Running(TaskKind::kTraining)) {
    messages_.Tell(Message::Level::kWarning, Tr("A training is running already. Cancel it first."));
    return false;
  }
  // Writing them would restore the recording that is removed.
  if (map_.unsaved()) {
    messages_.Tell(Message::Level::kWarning,
                   Tr("The map is being written. Try again in a moment."));
    return false;
  }
  return true;
}

void MapTraining::RestorePreviousMap() {
  if (project_.place() == nullptr || !MapIsFree()) {
    return;
  }
  const Result<PlaceRecordings> recordings =
      editor::RestorePreviousMap(project_.paths(), *project_.place());
  if (messages_.TellFailure(recordings.status())) {
    return;
  }
  NameRecordings(project_.place_name(), *recordings);
  messages_.Tell(Message::Level::kInfo,
                 Text(Tr("%s: the other map is in use. Doing so again changes back."),
                      project_.place_name().c_str()));
}

bool MapTraining::TakeNewReport() {
  if (trained_place_.empty() || trained_place_ != project_.place_name() ||
      map_.loads() == loads_before_ || map_.loaded().report == nullptr) {
    return false;
  }
  trained_place_.clear();
  return true;
}

}  // namespace lararium::editor
