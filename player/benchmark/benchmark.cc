#include "player/benchmark/benchmark.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "player/benchmark/benchmark_evaluation.h"
#include "player/benchmark/benchmark_report.h"
#include "player/benchmark/benchmark_sequence.h"
#include "shared/bundle/bundle.h"
#include "shared/core/json.h"
#include "shared/core/parallel.h"
#include "shared/show/show_content.h"
#include "shared/vision/pose_smoother.h"
#include "shared/vision/poses_file.h"
#include "shared/vision/scene_database.h"
#include "shared/vision/tracker.h"

namespace lararium::player {
namespace {

using geometry::CameraModel;
using geometry::Frame;
using Maps = std::vector<std::shared_ptr<const vision::SceneDatabase>>;

// Number of frames that are decoded before they are tracked.
constexpr size_t kBatch = 64;

// Processor time that all threads of the program have used, in milliseconds.
double ProcessCpuMilliseconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// A sample of the points of each map.
std::vector<std::vector<Eigen::Vector3d>> Landmarks(const Maps& maps) {
  constexpr size_t kCount = 2000;
  std::vector<std::vector<Eigen::Vector3d>> landmarks;
  for (const auto& map : maps) {
    std::vector<Eigen::Vector3d>& chosen = landmarks.emplace_back();
    for (size_t i = 0; i < map->points.size(); i += 1 + map->points.size() / kCount) {
      chosen.push_back(map->points[i].cast<double>());
    }
  }
  return landmarks;
}

// Scales and crops the middle of an image to a size.
cv::Mat CutTo(const cv::Mat& image, const cv::Size& size) {
  const double scale = std::min(image.cols / static_cast<double>(size.width),
                                image.rows / static_cast<double>(size.height));
  const cv::Size part(static_cast<int>(scale * size.width), static_cast<int>(scale * size.height));
  const cv::Point corner((image.cols - part.width) / 2, (image.rows - part.height) / 2);
  cv::Mat cut;
  cv::resize(image(cv::Rect(corner, part)), cut, size, 0.0, 0.0, cv::INTER_AREA);
  return cut;
}

std::string SmoothingName(vision::Smoothing smoothing) {
  switch (smoothing) {
    case vision::Smoothing::kOff:
      return "off";
    case vision::Smoothing::kSoft:
      return "soft";
    case vision::Smoothing::kStrong:
      return "strong";
  }
  return "";
}

class BenchmarkRun {
 public:
  BenchmarkRun(const BenchmarkOptions& options, std::vector<show::ShowPlace> places, Log& log)
      : options_(options), places_(std::move(places)), maps_(show::Maps(places_)), log_(log) {}

  Result<SequenceReport> Sequence(const BenchmarkSequence& sequence) const;
  Result<ForeignReport> Foreign(const std::filesystem::path& path,
                                const BenchmarkSequence& home) const;

 private:
  // Makes a tracker of images of this size.
  Result<std::unique_ptr<vision::PoseSource>> MakeTracker(const CameraModel& intrinsics,
                                                          int width,
                                                          int height) const {
    CameraModel camera = maps_.front()->camera.GuessForImages(width, height);
    vision::TrackerOptions tracking;
    tracking.known_camera = !options_.unknown_lens;
    if (tracking.known_camera) {
      LARARIUM_ASSIGN_OR_RETURN(camera, intrinsics.ForImages(width, height));
    }
    tracking.seed = options_.seed;
    tracking.threads = options_.threads;
    tracking.follow = !options_.first_pose;
    LARARIUM_ASSIGN_OR_RETURN(auto tracker, vision::CreateTracker(maps_, camera, tracking));
    show::SetOccluders(places_, *tracker);
    return vision::Smooth(std::move(tracker), maps_, options_.smoothing);
  }
  bool Enough(size_t frames) const {
    return options_.frames > 0 && frames >= static_cast<size_t>(options_.frames);
  }
  // Reads the next frames; empty at the end.
  Result<std::vector<Frame>> NextBatch(capture::FrameSource& source, size_t before) const;
  Status SavePoses(const BenchmarkSequence& sequence,
                   const std::vector<vision::PoseRecord>& poses) const;
  Status ShowForeign(const std::filesystem::path& path, ForeignReport& report) const;
  Status CutToForeign(const std::filesystem::path& path,
                      const BenchmarkSequence& home,
                      ForeignReport& report) const;

  const BenchmarkOptions& options_;
  std::vector<show::ShowPlace> places_;
  Maps maps_;
  Log& log_;
};

Result<std::vector<Frame>> BenchmarkRun::NextBatch(capture::FrameSource& source,
                                                   size_t before) const {
  std::vector<Frame> batch;
  while (batch.size() < kBatch && !Enough(before + batch.size())) {
    LARARIUM_ASSIGN_OR_RETURN(std::optional<Frame> frame, source.Next());
    if (!frame) {
      break;
    }
    batch.push_back(std::move(*frame));
  }
  return batch;
}

Status BenchmarkRun::SavePoses(const BenchmarkSequence& sequence,
                               const std::vector<vision::PoseRecord>& poses) const {
  if (options_.poses_out.empty()) {
    return Status();
  }
  std::error_code error;
  std::filesystem::create_directories(options_.poses_out, error);
  return vision::SavePoses(options_.poses_out / (sequence.name + ".json"), poses);
}

Result<SequenceReport> BenchmarkRun::Sequence(const BenchmarkSequence& sequence) const {
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenSequence(sequence));
  LARARIUM_ASSIGN_OR_RETURN(const auto tracker, MakeTracker(sequence.images.front().camera,
                                                            source->width(), source->height()));
  std::vector<FrameAnswer> answers;
  std::vector<vision::PoseRecord> poses;
  while (true) {
    LARARIUM_ASSIGN_OR_RETURN(const std::vector<Frame> batch, NextBatch(*source, answers.size()));
    if (batch.empty()) {
      break;
    }
    if (answers.empty() && options_.first_pose) {
      tracker->Track(batch.front());  // allocates buffers before times are measured
    }
    for (const Frame& frame : batch) {
      const auto start = std::chrono::steady_clock::now();
      const double start_cpu = ProcessCpuMilliseconds();
      const vision::TrackedFrame tracked = tracker->Track(frame);
      const double cpu = ProcessCpuMilliseconds() - start_cpu;
      const std::chrono::duration<double, std::milli> wall =
          std::chrono::steady_clock::now() - start;
      const std::string name = source->FrameName(frame.index);
      answers.push_back({.truth = sequence.Find(name),
                         .time = frame.capture_time,
                         .camera_from_map = tracked.camera_from_map,
                         .map = tracked.map,
                         .followed = tracked.followed,
                         .confidence = tracked.confidence,
                         .covariance = tracked.covariance,
                         .gain = {tracked.gain[0], tracked.gain[1], tracked.gain[2]},
                         .wall_ms = wall.count(),
                         .cpu_ms = cpu});
      poses.push_back(vision::MakePoseRecord(name, tracked));
    }
  }
  log_.Info("{}: {} frames", sequence.name, answers.size());
  LARARIUM_RETURN_IF_ERROR(SavePoses(sequence, poses));
  return SequenceReport{sequence.name, Evaluate(sequence, answers, Landmarks(maps_))};
}

Status BenchmarkRun::ShowForeign(const std::filesystem::path& path, ForeignReport& report) const {
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenForeign(path));
  const CameraModel guess = maps_.front()->camera.GuessForImages(source->width(), source->height());
  LARARIUM_ASSIGN_OR_RETURN(const auto tracker,
                            MakeTracker(guess, source->width(), source->height()));
  while (!Enough(report.frames)) {
    LARARIUM_ASSIGN_OR_RETURN(const std::optional<Frame> frame, source->Next());
    if (!frame) {
      break;
    }
    ++report.frames;
    if (tracker->Track(*frame).camera_from_map) {
      report.accepted.push_back(source->FrameName(frame->index));
    }
  }
  return Status();
}

// Alternates images of the place and of the other place, so that the tracker has a recent pose and
// a prediction when the other place appears.
Status BenchmarkRun::CutToForeign(const std::filesystem::path& path,
                                  const BenchmarkSequence& home,
                                  ForeignReport& report) const {
  LARARIUM_ASSIGN_OR_RETURN(const auto foreign, OpenForeign(path));
  LARARIUM_ASSIGN_OR_RETURN(const auto source, OpenSequence(home));
  LARARIUM_ASSIGN_OR_RETURN(const auto tracker, MakeTracker(home.images.front().camera,
                                                            source->width(), source->height()));
  LARARIUM_ASSIGN_OR_RETURN(std::optional<Frame> place, source->Next());
  bool waits = false;  // the next image of the place is the first after a cut
  while (place && !Enough(report.cuts)) {
    const bool tracked = tracker->Track(*place).camera_from_map.has_value();
    report.back_after_cut += waits && tracked;
    LARARIUM_ASSIGN_OR_RETURN(const std::optional<Frame> other, foreign->Next());
    if (!other) {
      break;
    }
    Frame cut = *place;  // keeps index and time, as if the camera were turned away
    cut.bgr = CutTo(other->bgr, place->bgr.size());
    cv::cvtColor(cut.bgr, cut.grey, cv::COLOR_BGR2GRAY);
    if (tracker->Track(cut).camera_from_map) {
      report.accepted_after_cut.push_back(foreign->FrameName(other->index));
    }
    ++report.cuts;
    waits = true;
    LARARIUM_ASSIGN_OR_RETURN(place, source->Next());
    if (!place) {
      LARARIUM_RETURN_IF_ERROR(source->Seek(0));
      LARARIUM_ASSIGN_OR_RETURN(place, source->Next());
    }
  }
  return Status();
}

Result<ForeignReport> BenchmarkRun::Foreign(const std::filesystem::path& path,
                                            const BenchmarkSequence& home) const {
  ForeignReport report;
  report.name = std::filesystem::absolute(path / "x").lexically_normal().parent_path().filename();
  LARARIUM_RETURN_IF_ERROR(ShowForeign(path, report));
  LARARIUM_RETURN_IF_ERROR(CutToForeign(path, home, report));
  log_.Info("{}: {} images of another place", report.name, report.frames);
  return report;
}

}  // namespace

Status Benchmark(const BenchmarkOptions& options, Log& log) {
  std::optional<ThreadLimit> limit;
  if (options.threads > 0) {
    limit.emplace(options.threads);
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto sequences, LoadBenchmarkSequences(options.sequences));
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(options.show));
  LARARIUM_ASSIGN_OR_RETURN(std::vector<show::ShowPlace> places,
                            show::LoadShowPlaces(bundle, options.place));
  const BenchmarkRun run(options, std::move(places), log);
  BenchmarkReport report;
  report.show = options.show.filename().string();
  report.mode = options.first_pose ? "every frame relocalised" : "following";
  report.mode += options.unknown_lens ? ", lens not told" : "";
  report.smoothing = SmoothingName(options.smoothing);
  report.threads = options.threads;
  for (const BenchmarkSequence& sequence : sequences) {
    LARARIUM_ASSIGN_OR_RETURN(report.sequences.emplace_back(), run.Sequence(sequence));
  }
  for (const std::filesystem::path& path : options.foreign) {
    LARARIUM_ASSIGN_OR_RETURN(report.foreign.emplace_back(), run.Foreign(path, sequences.front()));
  }
  PrintBenchmark(report, stdout);
  return options.stats_out.empty() ? Status() : SaveJson(options.stats_out, report.ToJson());
}

}  // namespace lararium::player
