#include "editor/jobs/training.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "editor/jobs/picked_frames.h"
#include "editor/jobs/previous_map.h"
#include "editor/jobs/staging.h"
#include "editor/jobs/training_report.h"
#include "editor/train/capture_report.h"
#include "editor/train/session_merge.h"
#include "shared/core/free_space.h"
#include "shared/vision/scene_database.h"

namespace lararium::editor {

namespace {

using vision::SceneDatabase;

train::TrainOptions OptionsFor(const SessionDocument& session, const TrainingOptions& options) {
  train::TrainOptions train;
  train.intrinsics = session.intrinsics;
  train.max_points = options.max_points.value_or(train.max_points);
  return train;
}

Result<train::TrainResult> MergeSession(const ProjectPaths& paths,
                                        const PlaceDocument& place,
                                        const SceneDatabase& map,
                                        const SessionDocument& session,
                                        const TrainingOptions& options,
                                        Progress& progress,
                                        Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenSource(paths, session.source));
  const uint32_t number = train::NextSession(map);
  LARARIUM_ASSIGN_OR_RETURN(
      train::TrainResult result,
      train::AddSession(map, *source, OptionsFor(session, options), progress, log));
  LARARIUM_RETURN_IF_ERROR(
      KeepPickedFrames(place, number, result.report, *source, result.database));
  return result;
}

// The map unit in metres, if the project determines it.
std::optional<double> MetresPerUnit(const PlaceDocument& place, const SceneDatabase& database) {
  const MapMeasures measures = MeasureMap(place, database);
  const ResolvedPicks resolved = ResolvePicks(place, database, measures);
  if (!measures.tags && !resolved.solution) {
    return std::nullopt;
  }
  return 1.0 / resolved.map_from_picked.scale;
}

Status WriteReport(const ProjectPaths& paths,
                   const PlaceDocument& place,
                   const SourceDocument& recording,
                   const train::TrainResult& result,
                   std::optional<double> metres_per_unit,
                   const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenSource(paths, recording));
  train::CaptureReportOptions options;
  options.title = place.name;
  options.source = std::filesystem::path(recording.path).filename().string();
  options.metres_per_unit = metres_per_unit;
  std::error_code error;
  const uintmax_t bytes = std::filesystem::file_size(paths.Scene(place.name), error);
  options.database_bytes = error ? 0 : bytes;
  options.frame_image = train::FrameImagesOf(*source);
  return train::WriteCaptureReport(result.report, result.database, file, options);
}

// Replaces the current map, which is kept as the previous one; if it has no report, place's
// recordings are its recordings.
Status ReplaceMap(const ProjectPaths& paths,
                  const PlaceDocument& place,
                  const SceneDatabase& database,
                  const TrainingReport& report) {
  LARARIUM_RETURN_IF_ERROR(KeepPreviousMap(paths, place));
  LARARIUM_RETURN_IF_ERROR(SaveMap(paths, place, database));
  return SaveTrainingReport(CurrentMap(paths, place.name).report, report);
}

// recordings: those of the new map. warnings: of those that the map had already. Writes the map
// before the report, so that a report that cannot be written does not lose the training.
Result<train::TrainReport> Finish(const ProjectPaths& paths,
                                  const PlaceDocument& place,
                                  const PlaceRecordings& recordings,
                                  const SourceDocument& recording,
                                  const std::vector<std::string>& warnings,
                                  train::TrainResult result,
                                  const TrainingOptions& options) {
  const std::optional<double> metres_per_unit = MetresPerUnit(place, result.database);
  TrainingReport report = DescribeTraining(recordings, recording, result, metres_per_unit);
  report.warnings.insert(report.warnings.begin(), warnings.begin(), warnings.end());
  LARARIUM_RETURN_IF_ERROR(ReplaceMap(paths, place, result.database, report));
  if (!options.report.empty()) {
    LARARIUM_RETURN_IF_ERROR(
        WriteReport(paths, place, recording, result, metres_per_unit, options.report));
  }
  return std::move(result.report);
}

// The step names of train::Train, with their shares of the time for the maquette.
std::vector<TaskStep> StepsOfOne() {
  // The last two only where the shutter rolls or autofocus moves.
  return {{"reading", 0.02},   {"features", 0.13}, {"matching", 0.25}, {"mapping", 0.30},
          {"refining", 0.10},  {"database", 0.02}, {"locating", 0.06}, {"shutter", 0.04},
          {"autofocus", 0.03}, {"database", 0.02}, {"locating", 0.06}};
}

}  // namespace

std::vector<TaskStep> SessionSteps() {
  std::vector<TaskStep> steps = StepsOfOne();
  steps.push_back({"merging", 0.15});
  return steps;
}

std::vector<TaskStep> TrainingSteps(size_t sessions) {
  std::vector<TaskStep> steps = StepsOfOne();
  for (size_t session = 0; session < sessions; ++session) {
    const std::vector<TaskStep> more = SessionSteps();
    steps.insert(steps.end(), more.begin(), more.end());
  }
  return steps;
}

Result<train::TrainReport> TrainPlace(const ProjectPaths& paths,
                                      const PlaceDocument& place,
                                      const TrainingOptions& options,
                                      Progress& progress,
                                      Log& log) {
  LARARIUM_RETURN_IF_ERROR(RequireSpace(paths.Scene(place.name).parent_path()));
  const SessionDocument first{place.training, place.intrinsics};
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenSource(paths, first.source));
  LARARIUM_ASSIGN_OR_RETURN(train::TrainResult result,
                            train::Train(*source, OptionsFor(first, options), progress, log));
  LARARIUM_RETURN_IF_ERROR(KeepPickedFrames(place, 0, result.report, *source, result.database));
  for (const SessionDocument& session : place.added) {
    log.Info("adding {}", session.source.path);
    LARARIUM_ASSIGN_OR_RETURN(
        train::TrainResult merged,
        MergeSession(paths, place, result.database, session, options, progress, log));
    result.database = std::move(merged.database);
    std::move(merged.report.notes.begin(), merged.report.notes.end(),
              std::back_inserter(result.report.notes));
    result.report.points = merged.report.points;
    result.report.observations = merged.report.observations;
    result.report.mean_reprojection_error_px = merged.report.mean_reprojection_error_px;
  }
  return Finish(paths, place, RecordingsOf(place), place.training, {}, std::move(result), options);
}

Result<train::TrainReport> TrainSession(const ProjectPaths& paths,
                                        const PlaceDocument& place,
                                        const SessionDocument& session,
                                        const TrainingOptions& options,
                                        Progress& progress,
                                        Log& log) {
  LARARIUM_RETURN_IF_ERROR(RequireSpace(paths.Scene(place.name).parent_path()));
  LARARIUM_ASSIGN_OR_RETURN(const SceneDatabase map, LoadMap(paths, place.name));
  LARARIUM_ASSIGN_OR_RETURN(train::TrainResult result,
                            MergeSession(paths, place, map, session, options, progress, log));
  PlaceRecordings recordings = RecordingsOf(place);
  recordings.added.push_back(session);
  return Finish(paths, place, recordings, session.source, MapWarnings(paths, place.name),
                std::move(result), options);
}

Result<train::RemovedSession> RemoveFromMap(const ProjectPaths& paths,
                                            const PlaceDocument& place,
                                            uint32_t session,
                                            Progress& progress) {
  progress.Report("removing a session", 0.0);
  LARARIUM_ASSIGN_OR_RETURN(const SceneDatabase map, LoadMap(paths, place.name));
  if (train::NextSession(map) != place.added.size() + 1) {
    return Status::Error(paths.Scene(place.name).string(), "has other recordings than the project",
                         "train the place again");
  }
  progress.Report("removing a session", 0.3);
  LARARIUM_ASSIGN_OR_RETURN(train::RemovedSession removed, train::RemoveSession(map, session));
  if (progress.Cancelled()) {
    return Status::Error(place.name, "cancelled");
  }
  progress.Report("removing a session", 0.8);
  PlaceDocument without = place;
  ForgetSession(without, session);
  LARARIUM_RETURN_IF_ERROR(SaveMap(paths, place, removed.database));
  LARARIUM_RETURN_IF_ERROR(ForgetPreviousMap(paths, place.name));
  TrainingReport report;  // The map was not trained here.
  report.recordings = RecordingsOf(without);
  report.warnings = MapWarnings(paths, place.name);
  const std::string file = paths.Resolve(place.added[session - 1].source.path).string();
  std::erase_if(report.warnings,
                [&](const std::string& warning) { return warning.starts_with(file); });
  LARARIUM_RETURN_IF_ERROR(SaveTrainingReport(CurrentMap(paths, place.name).report, report));
  return removed;
}

Status TakeMap(const ProjectPaths& paths,
               const PlaceDocument& place,
               const PlaceRecordings& recordings,
               const SceneDatabase& database,
               const std::vector<std::string>& warnings) {
  TrainingReport report;
  report.recordings = recordings;
  report.warnings = warnings;
  return ReplaceMap(paths, place, database, report);
}

std::vector<std::string> MapWarnings(const ProjectPaths& paths, const std::string& place) {
  Result<TrainingReport> report = LoadTrainingReport(CurrentMap(paths, place).report);
  return report.ok() ? std::move(report->warnings) : std::vector<std::string>();
}

Status SaveMap(const ProjectPaths& paths,
               const PlaceDocument& place,
               const SceneDatabase& database) {
  std::error_code error;
  std::filesystem::create_directories(paths.Place(place.name), error);
  if (error) {
    return Status::Error(paths.Place(place.name).string(),
                         "cannot make the folder: " + error.message());
  }
  return vision::SaveSceneDatabase(paths.Scene(place.name), database);
}

std::vector<vision::PoseRecord> PosesOf(const train::TrainReport& report) {
  // The names of videos' frames and of images are in the order of the frames.
  std::map<std::string, vision::PoseRecord> records;
  for (const train::LocatedFrame& frame : report.located) {
    vision::PoseRecord& record = records[frame.name];
    record = {frame.name, frame.camera, frame.camera_from_map, true};
    if (report.shutter) {
      record.shutter = {report.shutter->readout, frame.motion};
    }
  }
  for (const std::string& name : report.unlocated) {
    records[name] = {name, report.camera, std::nullopt};
  }
  std::vector<vision::PoseRecord> in_order;
  for (auto& [name, record] : records) {
    in_order.push_back(std::move(record));
  }
  return in_order;
}

Json ReportJson(const train::TrainReport& report) {
  const geometry::CameraModel& camera = report.camera;
  Json seconds = Json::object();
  for (const auto& [step, duration] : report.seconds) {
    seconds[step] = seconds.value(step, 0.0) + duration;  // Some steps are done twice.
  }
  Json cameras = Json::array();
  for (const train::CameraReport& of : report.cameras) {
    const geometry::CameraModel& c = of.camera;
    cameras.push_back({{"keyframes", of.keyframes},
                       {"given", of.given},
                       {"K", Json::array({c.fx, c.fy, c.cx, c.cy})},
                       {"k1_k2_p1_p2", Json::array({c.k1, c.k2, c.p1, c.p2})}});
  }
  return {{"frames", report.frames},
          {"keyframes", report.keyframes},
          {"located", report.located.size()},
          {"unlocated", report.unlocated},
          {"points", report.points},
          {"observations", report.observations},
          {"mean_reprojection_error_px", report.mean_reprojection_error_px},
          {"intrinsics_estimated", report.intrinsics_estimated},
          {"principal_point_estimated", report.principal_point_estimated},
          {"focal_deviation_px", report.focal_deviation_px},
          {"k1_k2_deviation", Json::array({report.k1_deviation, report.k2_deviation})},
          {"principal_point_deviation_px",
           Json::array({report.cx_deviation_px, report.cy_deviation_px})},
          {"K", Json::array({camera.fx, camera.fy, camera.cx, camera.cy})},
          {"k1_k2_p1_p2", Json::array({camera.k1, camera.k2, camera.p1, camera.p2})},
          {"cameras", cameras},
          {"warnings", report.notes},
          {"seconds", seconds}};
}

}  // namespace lararium::editor
