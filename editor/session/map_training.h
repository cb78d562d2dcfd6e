#pragma once

// Changes the map of the current place: trains it, merges recordings into it and removes them, and
// restores the map from before. The results arrive in the background and as messages. Use it from
// the interface thread only.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "editor/document/place_recordings.h"
#include "editor/jobs/background_task.h"
#include "editor/session/map_session.h"
#include "editor/session/message_log.h"
#include "editor/session/project_session.h"
#include "editor/train/trainer.h"
#include "shared/core/log.h"

namespace lararium::editor {

class MapTraining {
 public:
  // All arguments must outlive the training.
  MapTraining(
      ProjectSession& project, MapSession& map, TaskList& tasks, MessageLog& messages, Log& log)
      : project_(project), map_(map), tasks_(tasks), messages_(messages), log_(log) {}

  // Trains the current place from its recordings.
  void Train();
  // Trains the place of that name from another first recording; adds the place, with the title,
  // where it does not exist. Where the place already has a map, the document changes only after a
  // successful training, and the change cannot be undone.
  void TrainFrom(const std::string& name,
                 const std::string& title,
                 const SessionDocument& recording);
  // Merges a further recording into the map of the current place. The document changes only
  // afterwards, and the change cannot be undone.
  void AddSession(const SessionDocument& session);
  // Removes recording 1 or higher from the map of the current place. The document changes only
  // afterwards, and the change cannot be undone, because the map cannot get the recording back. Ask
  // the user first.
  void RemoveSession(uint32_t session);
  // Exchanges the map of the current place, and its recordings in the document, with the map from
  // before its last training. This is not part of undo; a second call reverses it.
  void RestorePreviousMap();
  // Returns true once after each training, when its map and report are loaded.
  bool TakeNewReport();

 private:
  // recordings: those of the current place's map after success.
  void Start(std::function<Result<train::TrainReport>(Progress&)> work,
             std::vector<TaskStep> steps,
             const PlaceRecordings& recordings);
  void TrainWith(const PlaceRecordings& recordings);
  // Enters the recordings of a place's map into the document.
  void NameRecordings(const std::string& place, const PlaceRecordings& recordings);
  // Returns false, and adds a message, while another task uses the map.
  bool MapIsFree();

  ProjectSession& project_;
  MapSession& map_;
  TaskList& tasks_;
  MessageLog& messages_;
  Log& log_;
  std::string trained_place_;  // The place whose report is to be shown; empty: none.
  int64_t loads_before_ = 0;   // MapSession::loads() at the end of that training.
};

}  // namespace lararium::editor
