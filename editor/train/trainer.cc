#include "editor/train/trainer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "editor/train/bundle_adjustment.h"
#include "editor/train/camera_transfer.h"
#include "editor/train/database_builder.h"
#include "editor/train/frame_locator.h"
#include "editor/train/image_mapping.h"
#include "editor/train/survey.h"
#include "editor/train/training_status.h"
#include "shared/vision/camera_filter.h"

namespace lararium::train {
namespace {

class Trainer {
 public:
  Trainer(capture::FrameSource& source,
          const TrainOptions& options,
          std::vector<TrainingCamera> cameras,
          Progress& progress,
          Log& log)
      : source_(source),
        options_(options),
        cameras_(std::move(cameras)),
        progress_(progress),
        log_(log) {}

  Result<TrainResult> Run() {
    LARARIUM_RETURN_IF_ERROR(Timed("reading", [&] { return Read(); }));
    LARARIUM_RETURN_IF_ERROR(Timed("features", [&] {
      return ExtractFeatures(survey_.keyframes, options_.max_features, progress_);
    }));
    LARARIUM_RETURN_IF_ERROR(Timed("matching", [&] { return Match(); }));
    LARARIUM_RETURN_IF_ERROR(Timed("mapping", [&] { return Map(); }));
    TrainResult result;
    LARARIUM_RETURN_IF_ERROR(BuildAndLocate(result.database));
    if (map_.reconstruction->cameras().size() == 1) {
      const bool rolls = AdjustsToShutter();
      const bool breathes = AdjustsToBreathing();
      if (rolls || breathes) {
        LARARIUM_RETURN_IF_ERROR(BuildAndLocate(result.database));
      }
      // Autofocus that was not known looked like a motion of the camera.
      if (breathes && AdjustsToShutter()) {
        LARARIUM_RETURN_IF_ERROR(BuildAndLocate(result.database));
      }
    }
    FillReport(result.database);
    if (options_.keep_features) {
      for (const uint32_t image : map_.reconstruction->LocatedImages()) {
        const vision::Features features = std::move(survey_.keyframes[image].features);
        result.features.push_back(
            FeaturesIn(result.database.camera, map_.reconstruction->camera(image), features));
      }
    }
    result.report = std::move(report_);
    return result;
  }

 private:
  template <typename Step>
  Status Timed(const char* name, Step step) {
    progress_.Report(name, 0.0);
    const auto start = std::chrono::steady_clock::now();
    const Status status = step();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    report_.seconds.emplace_back(name, seconds.count());
    log_.Info("{}: {:.1f} s", name, seconds.count());
    if (status.ok() && progress_.Cancelled()) {
      return Status::Error(kTraining, "cancelled");
    }
    return status;
  }

  Status Read() {
    Result<Survey> survey = SurveySource(source_, options_.max_keyframes, progress_, log_);
    report_.notes = source_.Notes();
    for (const std::string& note : report_.notes) {
      log_.Warn("{}", note);
    }
    LARARIUM_ASSIGN_OR_RETURN(survey_, std::move(survey));
    report_.frames = static_cast<int>(survey_.frames.size());
    report_.keyframes = static_cast<int>(survey_.keyframes.size());
    size_t keyframe = 0;
    for (const SurveyedFrame& frame : survey_.frames) {
      FrameReport& of_frame = report_.frame_reports.emplace_back();
      of_frame.frame_index = frame.index;
      of_frame.name = frame.name;
      of_frame.motion = frame.motion;
      if (keyframe < survey_.keyframes.size() &&
          survey_.keyframes[keyframe].frame_index == frame.index) {
        of_frame.keyframe = true;
        report_of_keyframe_.push_back(report_.frame_reports.size() - 1);
        ++keyframe;
      }
    }
    return Status();
  }

  ImageMappingOptions MappingOptions() const { return {cameras_, options_.seed}; }

  Status Match() {
    LARARIUM_ASSIGN_OR_RETURN(verified_,
                              MatchImages(survey_.keyframes, MappingOptions(), progress_, log_));
    report_.ordered = verified_.film_gap.has_value();
    return Status();
  }

  Status Map() {
    LARARIUM_ASSIGN_OR_RETURN(
        map_, MapImages(survey_.keyframes, verified_, MappingOptions(), progress_, log_));
    return Status();
  }

  // Which intrinsics the map determines.
  BundleOptions Refined() const {
    BundleOptions refined;
    refined.refine_intrinsics = !options_.intrinsics;
    refined.refine_centre =
        refined.refine_intrinsics &&
        map_.reconstruction->cameras().front().model.cx != verified_.cameras.front().model.cx &&
        map_.reconstruction->LensCount() == 1;
    refined.refine_readout = report_.shutter.has_value();
    refined.refine_breathing = !map_.reconstruction->times().empty();
    return refined;
  }

  // Estimates how the camera moved in each frame and, from that, whether its shutter rolls. Returns
  // whether the map has changed.
  bool AdjustsToShutter() {
    std::vector<FrameReport>& reports = report_.frame_reports;
    FillKeyframes();
    std::vector<TimedPose> poses;
    std::vector<FrameReport*> located;
    for (size_t i = 0; i < reports.size(); ++i) {  // Parallel to the survey's frames.
      if (reports[i].camera_from_map) {
        poses.push_back({survey_.frames[i].time, *reports[i].camera_from_map});
        located.push_back(&reports[i]);
      }
    }
    const std::vector<ImageMotion> motions = EstimateMotions(poses);
    for (size_t i = 0; i < located.size(); ++i) {
      located[i]->camera_motion = motions[i];
    }
    std::vector<ImageMotion> of_images;
    for (const size_t report : report_of_keyframe_) {
      of_images.push_back(reports[report].camera_motion);
    }
    progress_.Report("shutter", 0.0);
    const std::optional<Shutter> shutter = AdjustToShutter(
        *map_.reconstruction, map_.anchors, std::move(of_images), MapperOptions(), Refined(), log_);
    if (shutter) {
      report_.shutter = shutter;
    }
    return shutter.has_value();
  }

  // Estimates whether autofocus moved while a film was made. Returns whether the map has changed.
  bool AdjustsToBreathing() {
    if (!verified_.film_gap) {
      return false;
    }
    std::vector<double> times;
    for (const TrainingImage& image : survey_.keyframes) {
      times.push_back(TimeOf(image.frame_index));
    }
    progress_.Report("autofocus", 0.0);
    report_.focal_change = AdjustToBreathing(*map_.reconstruction, map_.anchors, std::move(times),
                                             MapperOptions(), Refined(), log_);
    return report_.focal_change.has_value();
  }

  Status LocateOthers(const vision::SceneDatabase& database) {
    if (survey_.keyframes.size() == survey_.frames.size()) {
      return Status();
    }
    FrameLocator locator(database);
    std::vector<FrameReport>& reports = report_.frame_reports;
    size_t next = 0;  // Index into reports.
    return ForOtherFrames(
        source_, survey_, progress_, log_, [&](std::span<const geometry::Frame> batch) {
          std::vector<FrameReport*> of_batch;
          std::vector<FrameToLocate> wanted;
          for (const geometry::Frame& frame : batch) {
            while (next < reports.size() && reports[next].frame_index < frame.index) {
              ++next;
            }
            // The survey may have failed to read the frame.
            const bool known = next < reports.size() && reports[next].frame_index == frame.index;
            of_batch.push_back(known ? &reports[next] : nullptr);
            wanted.push_back({&frame, CameraAssumed(frame.index),
                              known ? reports[next].camera_motion : ImageMotion::Zero()});
          }
          const std::vector<LocatedView> views = locator.Locate(wanted);
          for (size_t i = 0; i < batch.size(); ++i) {
            if (of_batch[i] != nullptr) {
              Fill(*of_batch[i], views[i]);
            }
          }
        });
  }

  // What is known of the camera that took a frame, and of its pose. The lens of a photograph is not
  // known if no keyframe is by the camera that the source names, or if keyframes show that several
  // cameras count as that one.
  vision::CameraGuess CameraAssumed(int64_t frame_index) const {
    const size_t source_camera = source_.CameraOf(frame_index);
    const Reconstruction& map = *map_.reconstruction;
    if (!map.times().empty()) {
      return {vision::ExactCamera(BreathingCamera(frame_index)), {}, BetweenKeyframes(frame_index)};
    }
    const TrainingCamera& assumed = map.cameras()[source_camera];
    std::vector<uint32_t> takers;  // Cameras of keyframes that count as by the same one.
    for (const uint32_t image : map.LocatedImages()) {
      if (survey_.keyframes[image].camera == source_camera) {
        takers.push_back(map.CameraOf(image));
      }
    }
    std::sort(takers.begin(), takers.end());
    takers.erase(std::unique(takers.begin(), takers.end()), takers.end());
    if (assumed.given || takers.size() == 1) {
      return {
          vision::ExactCamera(assumed.given ? assumed.model : map.cameras()[takers.front()].model),
          {},
          BetweenKeyframes(frame_index)};
    }
    vision::CameraGuess guess = vision::CameraFilter(assumed.model, false).Guess();
    if (assumed.FocalKnown()) {
      guess.prior.covariance(vision::kFocal, vision::kFocal) = std::pow(assumed.focal_doubt, 2);
    }
    for (const uint32_t taker : takers) {
      guess.candidates.push_back(map.cameras()[taker].model);
    }
    return guess;
  }

  // The camera between those of the keyframes before and after a frame, where autofocus moves.
  geometry::CameraModel BreathingCamera(int64_t frame_index) const {
    const Reconstruction& map = *map_.reconstruction;
    const double time = TimeOf(frame_index);
    const auto after = std::upper_bound(map.times().begin(), map.times().end(), time);
    const auto next =
        static_cast<uint32_t>(std::min(after - map.times().begin(), std::ssize(map.times()) - 1));
    const uint32_t last = next > 0 ? next - 1 : 0;
    const double gap = map.times()[next] - map.times()[last];
    const double share = gap > 0.0 ? std::clamp((time - map.times()[last]) / gap, 0.0, 1.0) : 0.0;
    geometry::CameraModel camera = map.camera(last);
    const double ratio = std::pow(map.camera(next).fx / camera.fx, share);
    camera.fx *= ratio;
    camera.fy *= ratio;
    return camera;
  }

  // A camera of frames as that of the upright images which the source put into them.
  geometry::CameraModel OfUprightImages(const geometry::CameraModel& model,
                                        size_t source_camera) const {
    const capture::SourceCamera from = source_.Cameras()[source_camera];
    TrainingCamera camera{model};
    camera.area = from.area;
    return ModelOfArea(camera).Resized(from.size.width, from.size.height);
  }

  // The time of the first frame from an index on that the survey could read.
  double TimeOf(int64_t frame_index) const {
    const auto frame =
        std::lower_bound(survey_.frames.begin(), survey_.frames.end() - 1, frame_index,
                         [](const SurveyedFrame& of, int64_t index) { return of.index < index; });
    return frame->time;
  }

  // The pose between those of the keyframes before and after a frame.
  std::optional<geometry::Rigid3> BetweenKeyframes(int64_t frame_index) const {
    const auto after = std::lower_bound(
        survey_.keyframes.begin(), survey_.keyframes.end(), frame_index,
        [](const TrainingImage& image, int64_t index) { return image.frame_index < index; });
    if (after == survey_.keyframes.begin() || after == survey_.keyframes.end()) {
      return std::nullopt;
    }
    const auto image = static_cast<uint32_t>(after - survey_.keyframes.begin());
    if (!map_.reconstruction->Located(image - 1) || !map_.reconstruction->Located(image)) {
      return std::nullopt;
    }
    const double begin = TimeOf(survey_.keyframes[image - 1].frame_index);
    const double share = (TimeOf(frame_index) - begin) / (TimeOf(after->frame_index) - begin);
    const geometry::Rigid3& from = map_.reconstruction->camera_from_map(image - 1);
    const geometry::Rigid3& to = map_.reconstruction->camera_from_map(image);
    const Eigen::Quaterniond rotation = from.rotation.slerp(share, to.rotation);
    return geometry::Rigid3{rotation,
                            -(rotation * ((1.0 - share) * from.Center() + share * to.Center()))};
  }

  static void Fill(FrameReport& report, const LocatedView& view) {
    report.camera_from_map = view.camera_from_map;
    report.camera = view.camera;
    report.features = view.features;
    report.observations = view.observations;
    report.median_error_px = view.median_error_px;
  }

  Status BuildAndLocate(vision::SceneDatabase& database) {
    LARARIUM_RETURN_IF_ERROR(Timed("database", [&] { return Build(database); }));
    return Timed("locating", [&] { return LocateOthers(database); });
  }

  Status Build(vision::SceneDatabase& database) {
    DatabaseOptions options;
    options.max_points = options_.max_points;
    options.session = options_.session;
    options.seed = options_.seed;
    database = BuildDatabase(*map_.reconstruction, survey_.keyframes, options);
    return database.Validate();
  }

  void FillKeyframes() {
    for (uint32_t image = 0; image < survey_.keyframes.size(); ++image) {
      LocatedView view = DescribeImage(*map_.reconstruction, image);
      view.features = static_cast<int>(survey_.keyframes[image].features.size());
      Fill(report_.frame_reports[report_of_keyframe_[image]], view);
    }
  }

  void FillReport(const vision::SceneDatabase& database) {
    FillKeyframes();
    if (!options_.intrinsics) {
      const BundleOptions refined = Refined();
      const IntrinsicsDeviation deviation =
          EstimateDeviation(*map_.reconstruction, map_.anchors[0], refined);
      report_.focal_deviation_px = deviation.focal_px;
      report_.k1_deviation = deviation.k1;
      report_.k2_deviation = deviation.k2;
      report_.principal_point_estimated = refined.refine_centre;
      report_.cx_deviation_px = deviation.cx_px;
      report_.cy_deviation_px = deviation.cy_px;
    }
    for (const FrameReport& frame : report_.frame_reports) {
      if (frame.camera_from_map) {
        report_.located.push_back(
            {frame.frame_index, frame.name, *frame.camera_from_map, frame.keyframe,
             frame.camera_motion,
             OfUprightImages(frame.camera, source_.CameraOf(frame.frame_index))});
      } else {
        report_.unlocated.push_back(frame.name);
      }
    }
    report_.points = static_cast<int>(database.points.size());
    report_.observations = static_cast<int>(database.observations.size());
    report_.mean_reprojection_error_px = database.mean_reprojection_error_px;
    report_.camera = database.camera;
    report_.cameras.resize(map_.reconstruction->cameras().size());
    for (const uint32_t image : map_.reconstruction->LocatedImages()) {
      const std::span<const TrainingCamera> cameras = map_.reconstruction->cameras();
      const uint32_t index = MeanCamera(cameras, map_.reconstruction->CameraOf(image));
      const uint32_t lens = LensOf(cameras, index);
      CameraReport& camera = report_.cameras[lens];
      if (lens == index || camera.keyframes == 0) {
        camera.camera = OfUprightImages(cameras[index].model, survey_.keyframes[image].camera);
      }
      camera.given = map_.reconstruction->cameras()[index].given;
      ++camera.keyframes;
    }
    std::erase_if(report_.cameras,
                  [](const CameraReport& camera) { return camera.keyframes == 0; });
    report_.intrinsics_estimated = !options_.intrinsics.has_value();
  }

  capture::FrameSource& source_;
  TrainOptions options_;
  std::vector<TrainingCamera> cameras_;  // The cameras of the source before training.
  Progress& progress_;
  Log& log_;
  TrainReport report_;
  Survey survey_;
  std::vector<size_t> report_of_keyframe_;  // [keyframes]: Index into frame_reports.
  VerifiedPairs verified_;
  SparseMap map_;
};

}  // namespace

Status TrainOptions::Validate() const {
  constexpr std::string_view kOptions = "training options";
  if (intrinsics) {
    LARARIUM_RETURN_IF_ERROR(intrinsics->Validate());
  }
  if (session >= 32) {
    return Status::Error(kOptions, "session must be below 32");
  }
  if (max_keyframes < 2 || max_keyframes > 2000) {
    return Status::Error(kOptions, "max_keyframes must lie between 2 and 2000");
  }
  if (max_features < 100 || max_features > 50'000) {
    return Status::Error(kOptions, "max_features must lie between 100 and 50000");
  }
  if (max_points < 100 || max_points > 10'000'000) {
    return Status::Error(kOptions, "max_points must lie between 100 and 10000000");
  }
  return Status();
}

Result<TrainResult> Train(capture::FrameSource& source,
                          const TrainOptions& options,
                          Progress& progress,
                          Log& log) {
  LARARIUM_RETURN_IF_ERROR(options.Validate());
  if (source.live()) {
    return Status::Error(kTraining, "a live camera has no end", "record a video first");
  }
  LARARIUM_ASSIGN_OR_RETURN(std::vector<TrainingCamera> cameras,
                            CamerasOf(source, options.intrinsics));
  return Trainer(source, options, std::move(cameras), progress, log).Run();
}

}  // namespace lararium::train
