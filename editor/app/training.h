#pragma once

// Trains a place of a project: from its recording to places/NAME/scene.larscene.

#include <optional>
#include <string>
#include <vector>

#include "editor/app/background_task.h"
#include "editor/app/place_recordings.h"
#include "editor/app/project.h"
#include "editor/train/session_removal.h"
#include "editor/train/trainer.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/vision/poses_file.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

struct TrainingOptions {
  std::optional<int> max_points;  // of the map; none: training's own limit
  std::filesystem::path report;   // where the capture report goes; empty: none
};

// What TrainPlace() does one after the other where a place has so many added sessions.
std::vector<TaskStep> TrainingSteps(size_t sessions);
// The same of TrainSession().
std::vector<TaskStep> SessionSteps();

// Trains from place.training, merges the sessions of place.added into it and
// writes the scene database, atomically, with a report for people (training_report.h). A failed,
// cancelled or killed training leaves an earlier one as it was; one that is replaced is kept
// beside it (former_map.h). The report is about place.training; points and error are those of the
// whole map.
Result<train::TrainReport> TrainPlace(const ProjectPaths& paths,
                                      const PlaceDocument& place,
                                      const TrainingOptions& options,
                                      Progress& progress,
                                      Log& log);

// Merges a further session into the map that is there, likewise. The report is
// about the session.
Result<train::TrainReport> TrainSession(const ProjectPaths& paths,
                                        const PlaceDocument& place,
                                        const SessionDocument& session,
                                        const TrainingOptions& options,
                                        Progress& progress,
                                        Log& log);

// Takes a further recording of the place, from 1 on, out of its map and writes it, atomically.
// The document is left as it is (ForgetSession()); the former map, which goes with what is
// forgotten, goes too.
Result<train::RemovedSession> RemoveFromMap(const ProjectPaths& paths,
                                            const PlaceDocument& place,
                                            uint32_t session,
                                            Progress& progress);

// Likewise a map that was not trained here. recordings: that it is made of; those of place are the
// former map's.
Status TakeMap(const ProjectPaths& paths,
               const PlaceDocument& place,
               const PlaceRecordings& recordings,
               const vision::SceneDatabase& database);

// Writes a map as the place's, atomically.
Status SaveMap(const ProjectPaths& paths,
               const PlaceDocument& place,
               const vision::SceneDatabase& database);

// One record for each frame of the source, in its order.
std::vector<vision::PoseRecord> PosesOf(const train::TrainReport& report);

// {"frames", "located", "keyframes", "points", "mean_reprojection_error_px", ...}
Json ReportJson(const train::TrainReport& report);

}  // namespace lararium::app
