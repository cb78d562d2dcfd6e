#pragma once

// Trains a place of a project: from its recording to places/NAME/scene.larscene.

#include <optional>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "editor/train/trainer.h"
#include "shared/core/log.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/vision/poses_file.h"

namespace lararium::app {

// Trains from place.training and writes the scene database, atomically. A
// failed or cancelled training leaves an earlier one as it was.
Result<train::TrainReport> TrainPlace(const ProjectPaths& paths,
                                      const PlaceDocument& place,
                                      Progress& progress,
                                      Log& log);

// Records a camera into a video file until stop says so; returns the frames.
// Training needs a recording: it looks at frames more than once.
Result<int64_t> RecordCamera(int number,
                             const std::filesystem::path& file,
                             double max_seconds,
                             Progress& progress);

// One record for each frame of the source, in its order.
std::vector<vision::PoseRecord> PosesOf(const train::TrainReport& report);

// {"frames", "located", "keyframes", "points", "mean_reprojection_error_px", ...}
Json ReportJson(const train::TrainReport& report);

}  // namespace lararium::app
