#include "editor/app/training.h"

#include <map>
#include <utility>

#include "editor/app/staging.h"
#include "shared/capture/video_writer.h"
#include "shared/vision/scene_database.h"

namespace lararium::app {

Result<train::TrainReport> TrainPlace(const ProjectPaths& paths,
                                      const PlaceDocument& place,
                                      Progress& progress,
                                      Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenSource(paths, place.training));
  train::TrainOptions options;
  options.intrinsics = place.intrinsics;
  if (!options.intrinsics && place.training.kind == SourceDocument::Kind::kImages) {
    options.focal_prior_px =
        capture::ExifFocalPixels(paths.Resolve(place.training.path) / source->FrameName(0),
                                 source->width(), source->height());
  }
  LARARIUM_ASSIGN_OR_RETURN(train::TrainResult result,
                            train::Train(*source, options, progress, log));
  std::error_code error;
  std::filesystem::create_directories(paths.Place(place.name), error);
  if (error) {
    return Status::Error(paths.Place(place.name).string(),
                         "cannot make the folder: " + error.message());
  }
  LARARIUM_RETURN_IF_ERROR(vision::SaveSceneDatabase(paths.Scene(place.name), result.database));
  return std::move(result.report);
}

Result<int64_t> RecordCamera(int number,
                             const std::filesystem::path& file,
                             double max_seconds,
                             Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const auto camera, capture::OpenCamera(number));
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) {
    return Status::Error(file.parent_path().string(), "cannot make the folder: " + error.message());
  }
  // The encoder takes even sizes only: at most one row and column are lost.
  const cv::Rect even(0, 0, camera->width() & ~1, camera->height() & ~1);
  LARARIUM_ASSIGN_OR_RETURN(
      const auto writer,
      capture::VideoWriter::Create(file, even.width, even.height, camera->frames_per_second()));
  int64_t frames = 0;
  std::optional<double> first_time;
  while (!progress.Cancelled()) {
    LARARIUM_ASSIGN_OR_RETURN(const auto frame, camera->Next());
    if (!frame) {
      break;
    }
    LARARIUM_RETURN_IF_ERROR(writer->Write(frame->bgr(even)));
    ++frames;
    first_time = first_time.value_or(frame->capture_time);
    const double seconds = frame->capture_time - *first_time;
    progress.Report("recording", seconds / max_seconds);
    if (seconds >= max_seconds) {
      break;
    }
  }
  if (progress.Cancelled()) {
    return Status::Error(file.string(), "recording was cancelled");
  }
  LARARIUM_RETURN_IF_ERROR(writer->Finish());
  return frames;
}

std::vector<vision::PoseRecord> PosesOf(const train::TrainReport& report) {
  // Names of videos and folders are in the order of their frames.
  std::map<std::string, std::optional<geometry::Rigid3>> poses;
  for (const train::LocatedFrame& frame : report.located) {
    poses[frame.name] = frame.camera_from_map;
  }
  for (const std::string& name : report.unlocated) {
    poses[name] = std::nullopt;
  }
  std::vector<vision::PoseRecord> records;
  for (const auto& [name, pose] : poses) {
    records.push_back({name, report.camera, pose, pose.has_value()});
  }
  return records;
}

Json ReportJson(const train::TrainReport& report) {
  const geometry::CameraModel& camera = report.camera;
  Json seconds = Json::object();
  for (const auto& [step, duration] : report.seconds) {
    seconds[step] = duration;
  }
  return {{"frames", report.frames},
          {"keyframes", report.keyframes},
          {"located", report.located.size()},
          {"unlocated", report.unlocated},
          {"points", report.points},
          {"observations", report.observations},
          {"mean_reprojection_error_px", report.mean_reprojection_error_px},
          {"intrinsics_estimated", report.intrinsics_estimated},
          {"K", Json::array({camera.fx, camera.fy, camera.cx, camera.cy})},
          {"k1_k2_p1_p2", Json::array({camera.k1, camera.k2, camera.p1, camera.p2})},
          {"seconds", seconds}};
}

}  // namespace lararium::app
