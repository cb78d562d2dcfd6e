#include <algorithm>
#include <cstdio>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "editor/check/stage_report.h"
#include "editor/cli/subcommands.h"
#include "editor/colmap/colmap_exchange.h"
#include "editor/document/named_entries.h"
#include "editor/document/project.h"
#include "editor/jobs/camera_measure.h"
#include "editor/jobs/filming.h"
#include "editor/jobs/previous_map.h"
#include "editor/jobs/staging.h"
#include "editor/jobs/training.h"
#include "editor/jobs/training_report.h"
#include "editor/text/text.h"
#include "editor/train/budget.h"
#include "editor/train/map_statistics.h"
#include "shared/vision/poses_file.h"
#include "shared/vision/scene_database.h"

// The subcommands that create maps and convert them to and from other formats.
namespace lararium::editor {

namespace {

using vision::SceneDatabase;

// The place to create a map for; it is added if it is new.
Result<PlaceDocument*> PlaceToTrain(ProjectDocument& document, const std::string& option) {
  std::string name = option;
  if (name.empty()) {
    name = document.places.size() == 1 ? document.places.front().name : "place";
  }
  const Result<PlaceDocument*> known = FindTitled(document.places, name, "--place", "has no place");
  if (known.ok()) {
    return known;
  }
  PlaceDocument place;
  LARARIUM_RETURN_IF_ERROR(NameEntry(document.places, "--place", name, "place", place));
  document.places.push_back(std::move(place));
  return &document.places.back();
}

// Training takes minutes, so unwritable outputs are refused before it.
Status CanBeWritten(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!file.empty() && !std::filesystem::is_directory(folder, ignored)) {
    return Status::Error(folder.string(), "is not a folder", "create it, or choose another one");
  }
  return Status();
}

// Records with a camera for `seconds` and reports what is still missing.
Status FilmWith(const std::string& camera,
                double seconds,
                const std::filesystem::path& file,
                Progress& progress,
                Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenFilmCamera(camera));
  for (const std::string& note : source->Notes()) {
    log.Warn("{}", note);
  }
  const auto next = [&](const FilmMoment& moment) {
    const std::string fault = FaultText(moment.coverage.fault, false);
    const std::string say = fault.empty() ? AdviceText(moment.coverage.advice, false) : fault;
    // Piped output gets a line for each tenth only, not for each percent.
    const int tenths = static_cast<int>(10.0 * moment.coverage.shares.all());
    const std::string step = "recording, " + std::to_string(10 * tenths) + " % covered: " + say;
    progress.Report(step, moment.seconds / seconds);
    if (progress.Cancelled()) {
      return FilmStep::kDiscard;
    }
    return moment.seconds >= seconds ? FilmStep::kFinish : FilmStep::kGoOn;
  };
  LARARIUM_ASSIGN_OR_RETURN(const Filmed filmed, Film(*source, file, next));
  if (!filmed.stopped.ok()) {
    return Status::Error(filmed.stopped.message(),
                         Text("the film until then, %.0f s, is kept", filmed.last.seconds),
                         "film again, or train from it with --video " + file.string());
  }
  return Status();
}

// The recording in the options. Records the place with a camera if requested, without replacing
// an existing video.
Result<SourceDocument> ChooseRecording(const TrainCommandOptions& options,
                                       const ProjectPaths& paths,
                                       const std::string& place,
                                       Progress& progress,
                                       Log& log) {
  if (!options.video.empty()) {
    return SourceDocument{SourceDocument::Kind::kVideo, paths.Shorten(options.video)};
  }
  if (!options.images.empty()) {
    return SourceDocument{SourceDocument::Kind::kImages, paths.Shorten(options.images)};
  }
  if (options.camera.empty()) {
    return SourceDocument{};
  }
  const std::filesystem::path file = NewFilmFile(paths.Place(place));
  LARARIUM_RETURN_IF_ERROR(FilmWith(options.camera, options.seconds, file, progress, log));
  return SourceDocument{SourceDocument::Kind::kVideo, paths.Shorten(file)};
}

Result<std::optional<geometry::CameraModel>> GivenIntrinsics(const std::vector<double>& numbers,
                                                             const ProjectPaths& paths,
                                                             const SourceDocument& recording) {
  if (numbers.empty()) {
    return std::optional<geometry::CameraModel>();
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenSource(paths, recording));
  LARARIUM_ASSIGN_OR_RETURN(
      const geometry::CameraModel camera,
      geometry::CameraModel::FromNumbers(numbers, source->width(), source->height()));
  return std::optional(camera);
}

Result<train::TrainReport> TrainFirst(const TrainCommandOptions& options,
                                      const TrainingOptions& training,
                                      const ProjectPaths& paths,
                                      PlaceDocument& place,
                                      Progress& progress,
                                      Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(const SourceDocument recording,
                            ChooseRecording(options, paths, place.name, progress, log));
  if (!recording.empty()) {
    place.training = recording;
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto intrinsics,
                            GivenIntrinsics(options.intrinsics, paths, place.training));
  if (intrinsics) {
    place.intrinsics = intrinsics;
  }
  return TrainPlace(paths, place, training, progress, log);
}

Result<train::TrainReport> TrainAnother(const TrainCommandOptions& options,
                                        const TrainingOptions& training,
                                        const ProjectPaths& paths,
                                        PlaceDocument& place,
                                        Progress& progress,
                                        Log& log) {
  if (place.added.size() == kMaxAddedSessions) {
    return Status::Error(place.name, "has as many recordings as a map can hold",
                         "train it again from the best of them");
  }
  SessionDocument session;
  LARARIUM_ASSIGN_OR_RETURN(session.source,
                            ChooseRecording(options, paths, place.name, progress, log));
  LARARIUM_ASSIGN_OR_RETURN(session.intrinsics,
                            GivenIntrinsics(options.intrinsics, paths, session.source));
  LARARIUM_ASSIGN_OR_RETURN(train::TrainReport report,
                            TrainSession(paths, place, session, training, progress, log));
  place.added.push_back(std::move(session));
  return report;
}

// Describes the uncertainty of an estimated camera.
std::string CameraSummary(const train::TrainReport& report) {
  char text[256];
  std::snprintf(text, sizeof(text),
                "camera: focal length %.1f +- %.1f px, k1 %.4f +- %.4f, k2 %.4f +- %.4f, principal "
                "point %.1f, %.1f%s\n",
                report.camera.fx, report.focal_deviation_px, report.camera.k1, report.k1_deviation,
                report.camera.k2, report.k2_deviation, report.camera.cx, report.camera.cy,
                report.principal_point_estimated ? "" : " (assumed)");
  std::string summary = text;
  if (report.cameras.size() > 1) {
    summary = "photographs by " + std::to_string(report.cameras.size()) +
              " cameras; that of most, then all:\n" + summary;
    for (const train::CameraReport& of : report.cameras) {
      std::snprintf(text, sizeof(text),
                    "  %d keyframes: focal length %.1f px, k1 %.4f, k2 %.4f%s\n", of.keyframes,
                    of.camera.fx, of.camera.k1, of.camera.k2, of.given ? " (given)" : "");
      summary += text;
    }
  }
  if (report.shutter) {
    const Eigen::Vector2d& readout = report.shutter->readout;
    std::snprintf(text, sizeof(text),
                  "shutter: rolling; an image is read in %.3f of the frame time, by %s\n",
                  readout.cwiseAbs().maxCoeff(),
                  std::abs(readout.x()) > std::abs(readout.y()) ? "columns" : "rows");
    summary += text;
  }
  if (report.focal_change) {
    std::snprintf(text, sizeof(text),
                  "autofocus: it moved the focal length by %.2f %% (root mean square); the map "
                  "allows for it\n",
                  100.0 * *report.focal_change);
    summary += text;
  }
  return summary;
}

// {"points", "descriptors", "images", "bytes", "recall", ...} for each budget.
Json BudgetJson(const std::vector<train::BudgetRow>& rows) {
  Json json = Json::array();
  for (const train::BudgetRow& row : rows) {
    json.push_back({{"points", row.points},
                    {"descriptors", row.descriptors},
                    {"images", row.images},
                    {"bytes", row.bytes},
                    {"recall", row.recall},
                    {"median_difference_px", row.median_difference_px}});
  }
  return json;
}

std::string BudgetText(const std::vector<train::BudgetRow>& rows) {
  std::string text = "  points  images       MB  located  difference px\n";
  for (const train::BudgetRow& row : rows) {
    char line[128];
    std::snprintf(line, sizeof(line), "%8d  %6d  %7.1f  %5.1f %%  %13.3f\n", row.points, row.images,
                  1e-6 * static_cast<double>(row.bytes), 100.0 * row.recall,
                  row.median_difference_px);
    text += line;
  }
  return text;
}

// The complete map, then successive halves, and the requested size.
std::vector<train::BudgetOptions> BudgetsFor(const SceneDatabase& database,
                                             const std::optional<int>& points) {
  constexpr int kFewPoints = 1000;
  constexpr int kFewest = 100;  // The smallest budget that may be requested.
  const int all = std::max(static_cast<int>(database.points.size()), kFewest);
  std::set<int, std::greater<>> counts = {all};
  for (int count = all / 2; count >= kFewPoints; count /= 2) {
    counts.insert(count);
  }
  if (points) {
    counts.insert(std::min(*points, all));
  }
  std::vector<train::BudgetOptions> budgets;
  for (const int count : counts) {
    budgets.push_back({.max_points = count});
  }
  return budgets;
}

// Removes a session from the map of a place. Fails if the place or the session does not exist.
Result<CommandResult> RemoveSession(const ProjectPaths& paths,
                                    ProjectDocument& document,
                                    const std::string& place_name,
                                    int session,
                                    Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, ChoosePlace(paths, document, place_name));
  PlaceDocument& place = *document.FindPlace(name);
  const auto number = static_cast<uint32_t>(session);
  if (number > place.added.size()) {
    return Status::Error("--remove-session " + std::to_string(session),
                         "is not one of the " + std::to_string(place.added.size()) +
                             " recordings that were added to " + name,
                         "1 is the first that was added");
  }
  LARARIUM_ASSIGN_OR_RETURN(const train::RemovedSession removed,
                            RemoveFromMap(paths, place, number, progress));
  const std::string source = place.added[number - 1].source.path;
  ForgetSession(place, number);
  LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
  return CommandResult{
      name + ": removed " + source + ", " + std::to_string(removed.keyframes) + " keyframes, " +
          std::to_string(removed.points) + " points; " +
          std::to_string(removed.database.points.size()) + " points stay\n",
      {{"place", name},
       {"removed", source},
       {"keyframes", removed.database.keyframes.size()},
       {"points", removed.database.points.size()},
       {"removed_keyframes", removed.keyframes},
       {"removed_points", removed.points},
       {"mean_reprojection_error_px", removed.database.mean_reprojection_error_px}}};
}

Result<CommandResult> PutBack(const ProjectPaths& paths,
                              ProjectDocument& document,
                              const std::string& place_name) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, ChoosePlace(paths, document, place_name));
  PlaceDocument& place = *document.FindPlace(name);
  LARARIUM_ASSIGN_OR_RETURN(const PlaceRecordings recordings, RestorePreviousMap(paths, place));
  SetRecordings(recordings, place);
  LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
  LARARIUM_ASSIGN_OR_RETURN(const SceneDatabase database, LoadMap(paths, name));
  return CommandResult{name + ": the map from before the last training is back, " +
                           std::to_string(database.keyframes.size()) + " keyframes, " +
                           std::to_string(database.points.size()) +
                           " points; --put-back again brings the other\n",
                       {{"place", name},
                        {"keyframes", database.keyframes.size()},
                        {"points", database.points.size()},
                        {"mean_reprojection_error_px", database.mean_reprojection_error_px}}};
}

}  // namespace

Result<CommandResult> RunTrain(const TrainCommandOptions& options, Progress& progress, Log& log) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  if (options.remove_session) {
    return RemoveSession(paths, document, options.place, *options.remove_session, progress);
  }
  if (options.put_back) {
    return PutBack(paths, document, options.place);
  }
  LARARIUM_ASSIGN_OR_RETURN(PlaceDocument * place, PlaceToTrain(document, options.place));
  LARARIUM_RETURN_IF_ERROR(CanBeWritten(options.report));
  LARARIUM_RETURN_IF_ERROR(CanBeWritten(options.poses_out));
  if (options.tag_size) {
    const train::TagOptions tags{options.tag_family, *options.tag_size};
    LARARIUM_RETURN_IF_ERROR(tags.Validate());
    place->tags = TagsDocument{tags.family, tags.size_m};
  }
  const TrainingOptions training{options.points, options.report};
  LARARIUM_ASSIGN_OR_RETURN(const train::TrainReport report,
                            options.add
                                ? TrainAnother(options, training, paths, *place, progress, log)
                                : TrainFirst(options, training, paths, *place, progress, log));
  if (!place->camera) {
    // Only the appearance of people depends on this.
    if (const auto camera = MeasureCamera(paths, *place, progress); camera.ok()) {
      place->camera = *camera;
    } else {
      log.Warn("{}", camera.message());
    }
  }
  LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
  if (!options.poses_out.empty()) {
    LARARIUM_RETURN_IF_ERROR(vision::SavePoses(options.poses_out, PosesOf(report)));
  }
  LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths, *place));
  const StageReport stage = ReportStage(document, *place, map);
  LARARIUM_ASSIGN_OR_RETURN(const TrainingReport told,
                            LoadTrainingReport(CurrentMap(paths, place->name).report));
  CommandResult result{TrainingText(place->name, told), ReportJson(report)};
  result.text += (report.intrinsics_estimated ? CameraSummary(report) : "") + stage.text;
  result.json.update(TrainingJson(told));
  result.json["place"] = place->name;
  result.json["stage"] = stage.json;
  return result;
}

Result<CommandResult> RunImportColmap(const ImportColmapOptions& options,
                                      Progress& progress,
                                      Log& log) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(PlaceDocument * place, PlaceToTrain(document, options.place));
  LARARIUM_ASSIGN_OR_RETURN(const train::ColmapFolders folders,
                            train::FindColmapFolders(options.model, options.images));
  std::vector<std::string> warnings;
  LARARIUM_ASSIGN_OR_RETURN(
      const SceneDatabase database,
      train::ImportColmap(folders.model, folders.images, {}, progress, log, warnings));
  // Training again would start from these images with the camera of the model.
  const PlaceRecordings recordings{
      {SourceDocument::Kind::kImages, paths.Shorten(folders.images)}, database.camera, {}};
  LARARIUM_RETURN_IF_ERROR(TakeMap(paths, *place, recordings, database, warnings));
  SetRecordings(recordings, *place);
  LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
  CommandResult result;
  for (const std::string& warning : warnings) {
    result.text += "warning: " + warning + "\n";
  }
  result.text += place->name + ": " + std::to_string(database.keyframes.size()) + " images, " +
                 std::to_string(database.points.size()) + " points\n";
  result.json = {{"place", place->name},
                 {"keyframes", database.keyframes.size()},
                 {"points", database.points.size()},
                 {"mean_reprojection_error_px", database.mean_reprojection_error_px},
                 {"warnings", warnings}};
  return result;
}

Result<CommandResult> RunExportColmap(const ExportColmapOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const std::string place, ChoosePlace(paths, document, options.place));
  LARARIUM_ASSIGN_OR_RETURN(const SceneDatabase database, LoadMap(paths, place));
  LARARIUM_RETURN_IF_ERROR(
      train::ExportColmap(database, options.model,
                          options.text ? train::ColmapFormat::kText : train::ColmapFormat::kBinary,
                          options.with_images));
  return CommandResult{"wrote " + options.model.string() + "\n",
                       {{"out", options.model.string()},
                        {"keyframes", database.keyframes.size()},
                        {"points", database.points.size()}}};
}

Result<CommandResult> RunMeasure(const MeasureOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, ChoosePlace(paths, document, options.place));
  PlaceDocument& place = *document.FindPlace(name);
  LARARIUM_ASSIGN_OR_RETURN(const StagedMap map, LoadStagedMap(paths, place));
  LARARIUM_RETURN_IF_ERROR(map.picks.problem);
  const auto count = static_cast<int>(map.database->points.size());
  for (const int point : {options.from, options.to}) {
    if (point >= count) {
      return Status::Error("point " + std::to_string(point),
                           "is not one of the map's " + std::to_string(count) + " points",
                           "count from 0");
    }
  }
  const Eigen::Vector3d from =
      map.database->points[static_cast<size_t>(options.from)].cast<double>();
  const Eigen::Vector3d to = map.database->points[static_cast<size_t>(options.to)].cast<double>();
  const geometry::Similarity3 map_from_stage = map.picks.map_from_picked * place.picked_from_stage;
  const double said = StageDistance(map_from_stage, from, to);
  if (!(said > 0.0)) {
    return Status::Error("point " + std::to_string(options.to),
                         "is at the same position as the other one",
                         "choose two points that are apart");
  }
  const std::optional<double> deviation = train::DistanceDeviation(
      *map.database, train::MeasureStatistics(*map.database), static_cast<uint32_t>(options.from),
      static_cast<uint32_t>(options.to));
  CommandResult result{Text("%s: %.4f m", name.c_str(), said),
                       {{"place", name}, {"distance_m", said}}};
  if (deviation) {
    const double metres = *deviation / map_from_stage.scale;
    result.text += Text(" +- %.4f m", metres);
    result.json["deviation_m"] = metres;
  }
  if (options.metres) {
    place.picked_from_stage = ScaledToDistance(map.picks.map_from_picked, place.picked_from_stage,
                                               from, to, *options.metres);
    const double scale = place.picked_from_stage.scale;
    if (!(scale >= kMinStageScale && scale <= kMaxStageScale)) {
      return Status::Error("--metres", "would make the stage impossibly large or small",
                           "measure between other points");
    }
    LARARIUM_RETURN_IF_ERROR(SaveProject(paths, document));
    const double residual = 100.0 * (said / *options.metres - 1.0);
    result.text += Text(", %+.2f %% off; the stage was scaled", residual);
    result.json["residual_percent"] = residual;
    result.json["scale"] = scale;
  }
  result.text += "\n";
  return result;
}

Result<CommandResult> RunPrune(const PruneOptions& options, Progress& progress) {
  constexpr size_t kStride = 4;  // Every fourth view is held out.
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const std::string name, ChoosePlace(paths, document, options.place));
  LARARIUM_ASSIGN_OR_RETURN(const SceneDatabase database, LoadMap(paths, name));
  LARARIUM_ASSIGN_OR_RETURN(
      const std::vector<train::BudgetRow> rows,
      train::MeasureBudgets(database, BudgetsFor(database, options.points), kStride, progress));
  CommandResult result{BudgetText(rows), {{"place", name}, {"budgets", BudgetJson(rows)}}};
  if (options.points) {
    const SceneDatabase pruned = train::Prune(database, {.max_points = *options.points});
    LARARIUM_RETURN_IF_ERROR(vision::SaveSceneDatabase(paths.Scene(name), pruned));
    result.text += name + ": " + std::to_string(pruned.points.size()) + " points stay\n";
    result.json["points"] = pruned.points.size();
  }
  return result;
}

}  // namespace lararium::editor
