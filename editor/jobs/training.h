#pragma once

// Trains a place of a project: from its recordings to places/NAME/scene.larscene.

#include <optional>
#include <string>
#include <vector>

#include "editor/document/place_recordings.h"
#include "editor/document/project.h"
#include "editor/jobs/background_task.h"
#include "editor/train/session_removal.h"
#include "editor/train/trainer.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/vision/poses_file.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

struct TrainingOptions {
  std::optional<int> max_points;  // Limit for the map; not set: the default of training.
  std::filesystem::path report;   // The file for the capture report; empty: none.
};

// The steps of TrainPlace() for a place with the given number of added sessions.
std::vector<TaskStep> TrainingSteps(size_t sessions);
// The steps of TrainSession().
std::vector<TaskStep> SessionSteps();

// Trains from place.training, merges the sessions of place.added into the map and writes it
// atomically, with a report for people (training_report.h). A failed, cancelled or killed training
// leaves the current map unchanged; a map that is replaced is kept as the previous map
// (previous_map.h). The report is about place.training, except that points and error are those of
// the whole map.
Result<train::TrainReport> TrainPlace(const ProjectPaths& paths,
                                      const PlaceDocument& place,
                                      const TrainingOptions& options,
                                      Progress& progress,
                                      Log& log);

// Merges a further session into the existing map and writes it like TrainPlace(). The report is
// about the session.
Result<train::TrainReport> TrainSession(const ProjectPaths& paths,
                                        const PlaceDocument& place,
                                        const SessionDocument& session,
                                        const TrainingOptions& options,
                                        Progress& progress,
                                        Log& log);

// Removes session 1 or higher from the place's map and writes the map atomically. Also deletes the
// previous map, which still contains the session. The document stays unchanged; the caller calls
// ForgetSession().
Result<train::RemovedSession> RemoveFromMap(const ProjectPaths& paths,
                                            const PlaceDocument& place,
                                            uint32_t session,
                                            Progress& progress);

// Writes a map that was not trained here like TrainPlace(). recordings: those of the new map; those
// of place belong to the previous map. warnings: see TrainingReport.
Status TakeMap(const ProjectPaths& paths,
               const PlaceDocument& place,
               const PlaceRecordings& recordings,
               const vision::SceneDatabase& database,
               const std::vector<std::string>& warnings = {});

// TrainingReport::warnings of a place's map. Empty if the place is not trained or has no report.
std::vector<std::string> MapWarnings(const ProjectPaths& paths, const std::string& place);

// Writes the map of a place, atomically.
Status SaveMap(const ProjectPaths& paths,
               const PlaceDocument& place,
               const vision::SceneDatabase& database);

// One record for each frame of the source, in order.
std::vector<vision::PoseRecord> PosesOf(const train::TrainReport& report);

// {"frames", "located", "keyframes", "points", "mean_reprojection_error_px", ...}
Json ReportJson(const train::TrainReport& report);

}  // namespace lararium::editor
