#include "editor/jobs/filming.h"

#include <chrono>
#include <utility>

#include "editor/text/text.h"
#include "editor/train/corner_tracker.h"
#include "shared/capture/video_writer.h"
#include "shared/core/file.h"

namespace lararium::editor {

namespace {

using train::CoverageAdvice;
using train::CoverageFault;

// A recording that delivers each frame at its capture time.
class PacedRecording : public capture::FrameSource {
 public:
  explicit PacedRecording(std::unique_ptr<FrameSource> recording)
      : recording_(std::move(recording)) {}

  Result<std::optional<geometry::Frame>> Next() override {
    LARARIUM_ASSIGN_OR_RETURN(std::optional<geometry::Frame> frame, recording_->Next());
    if (frame) {
      const auto now = std::chrono::steady_clock::now();
      begin_ = begin_.value_or(now);
      std::this_thread::sleep_until(*begin_ +
                                    std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(frame->capture_time)));
    }
    return frame;
  }
  Status Seek(int64_t) override { return Status::Error("camera", "a live camera cannot seek"); }
  std::optional<int64_t> frame_count() const override { return std::nullopt; }
  int width() const override { return recording_->width(); }
  int height() const override { return recording_->height(); }
  double frames_per_second() const override { return recording_->frames_per_second(); }
  bool live() const override { return true; }
  std::string FrameName(int64_t index) const override { return recording_->FrameName(index); }
  std::vector<std::string> Notes() const override { return recording_->Notes(); }

 private:
  using Clock = std::chrono::steady_clock;
  std::unique_ptr<FrameSource> recording_;
  std::optional<Clock::time_point> begin_;
};

Status MakeFolderOf(const std::filesystem::path& file) {
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  return error ? Status::Error(file.parent_path().string(),
                               "cannot make the folder: " + error.message())
               : Status();
}

// Writes the frames of a camera and measures which views of the place they cover.
class Recorder {
 public:
  static Result<std::unique_ptr<Recorder>> Create(const capture::FrameSource& camera,
                                                  const std::filesystem::path& file) {
    // The encoder accepts only even sizes, so at most one row and one column are lost.
    const cv::Rect even(0, 0, camera.width() & ~1, camera.height() & ~1);
    LARARIUM_ASSIGN_OR_RETURN(
        auto writer,
        capture::VideoWriter::Create(file, even.width, even.height, camera.frames_per_second()));
    return std::unique_ptr<Recorder>(new Recorder(camera, even, std::move(writer)));
  }

  // moment: holds the state after the previous frame, and is updated unless this frame cannot be
  // written.
  Status Add(const geometry::Frame& frame, FilmMoment& moment) {
    first_time_ = first_time_.value_or(frame.capture_time);
    const double seconds = frame.capture_time - *first_time_;
    LARARIUM_RETURN_IF_ERROR(writer_->Write(frame.bgr(even_), seconds));
    moment.seconds = seconds;
    moment.coverage = guide_.Add(tracker_.Measure(frame.grey, seconds));
    moment.cells = guide_.cells();
    moment.bgr = std::make_shared<const cv::Mat>(frame.bgr.clone());
    ++moment.frames;
    return Status();
  }

  Status Finish() { return writer_->Finish(); }

 private:
  Recorder(const capture::FrameSource& camera,
           const cv::Rect& even,
           std::unique_ptr<capture::VideoWriter> writer)
      : even_(even),
        writer_(std::move(writer)),
        model_(train::TypicalCamera(camera.width(), camera.height())),
        tracker_(model_),
        guide_(train::HalfView(model_)) {}

  cv::Rect even_;
  std::unique_ptr<capture::VideoWriter> writer_;
  geometry::CameraModel model_;
  train::CornerTracker tracker_;
  train::CoverageGuide guide_;
  std::optional<double> first_time_;
};

}  // namespace

std::unique_ptr<capture::FrameSource> AtItsOwnPace(
    std::unique_ptr<capture::FrameSource> recording) {
  return std::make_unique<PacedRecording>(std::move(recording));
}

bool IsCameraNumber(const std::string& camera) {
  constexpr size_t kMostDigits = 4;
  return !camera.empty() && camera.size() <= kMostDigits &&
         camera.find_first_not_of("0123456789") == std::string::npos;
}

Result<std::unique_ptr<capture::FrameSource>> OpenFilmCamera(const std::string& camera) {
  if (IsCameraNumber(camera)) {
    return capture::OpenCamera(std::stoi(camera));
  }
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<capture::FrameSource> recording,
                            capture::OpenVideo(camera));
  return AtItsOwnPace(std::move(recording));
}

Result<Filmed> Film(capture::FrameSource& camera,
                    const std::filesystem::path& file,
                    const std::function<FilmStep(const FilmMoment&)>& next,
                    const FreeSpace& free_space) {
  constexpr uint64_t kLeast = 64'000'000;  // Bytes for the index and frames still to be written.
  LARARIUM_RETURN_IF_ERROR(MakeFolderOf(file));
  LARARIUM_ASSIGN_OR_RETURN(const auto recorder, Recorder::Create(camera, file));
  Filmed filmed;
  FilmStep step = FilmStep::kGoOn;
  while (step == FilmStep::kGoOn) {
    const auto frame = camera.Next();
    filmed.stopped =
        frame.ok() ? RequireSpace(file.parent_path(), kLeast, free_space) : frame.status();
    if (!filmed.stopped.ok() || !*frame) {
      break;
    }
    filmed.stopped = recorder->Add(**frame, filmed.last);
    if (!filmed.stopped.ok()) {
      break;
    }
    step = next(filmed.last);
  }
  if (step == FilmStep::kDiscard) {
    return Status::Error(file.string(), "recording was cancelled");
  }
  Status problem = filmed.last.frames > 0 ? recorder->Finish()
                                          : Status::Error("the camera", "gave no image",
                                                          "check whether another program uses it");
  if (!problem.ok()) {
    return filmed.stopped.ok() ? problem : filmed.stopped;  // Reports the first error.
  }
  return filmed;
}

std::filesystem::path NewFilmFile(const std::filesystem::path& folder) {
  for (int number = 1;; ++number) {
    std::filesystem::path file = folder / ("film-" + std::to_string(number) + ".mp4");
    if (!FileExists(file)) {
      return file;
    }
  }
}

std::string FaultText(CoverageFault fault, bool translated) {
  const auto say = [translated](const char* text) { return translated ? Tr(text) : text; };
  switch (fault) {
    case CoverageFault::kNone:
      return "";
    case CoverageFault::kDark:
      return say(TrLater("Too dark: more light, or film where it is lighter"));
    case CoverageFault::kBright:
      return say(TrLater("Much of the image is white or black: keep windows and lamps out of it"));
    case CoverageFault::kBlurred:
      return say(TrLater("Blurred: move more slowly"));
    case CoverageFault::kFast:
      return say(TrLater("Too fast: move more slowly"));
    case CoverageFault::kBare:
      return say(TrLater("Nothing to hold on to: let things with texture into the image"));
    case CoverageFault::kStanding:
      return say(TrLater("Standing still: walk"));
    case CoverageFault::kTurning:
      return say(TrLater("Only turning: walk sideways past things"));
  }
  return "";
}

std::string AdviceText(CoverageAdvice advice, bool translated) {
  const auto say = [translated](const char* text) { return translated ? Tr(text) : text; };
  switch (advice) {
    case CoverageAdvice::kStepLeft:
      return say(TrLater("Walk to the left"));
    case CoverageAdvice::kStepRight:
      return say(TrLater("Walk to the right"));
    case CoverageAdvice::kLookLeft:
      return say(TrLater("Look further to the left"));
    case CoverageAdvice::kLookRight:
      return say(TrLater("Look further to the right"));
    case CoverageAdvice::kLookDown:
      return say(TrLater("Look down, at the floor"));
    case CoverageAdvice::kGoNearer:
      return say(TrLater("Go nearer"));
    case CoverageAdvice::kStepBack:
      return say(TrLater("Step back"));
    case CoverageAdvice::kEnough:
      return say(TrLater("Covered: walk back to where you began, then stop"));
  }
  return "";
}

FilmTask::FilmTask(std::unique_ptr<capture::FrameSource> camera, std::filesystem::path file)
    : file_(std::move(file)),
      thread_([this, camera = std::shared_ptr<capture::FrameSource>(std::move(camera))] {
        Result<Filmed> filmed = Film(*camera, file_, [this](const FilmMoment& moment) {
          const std::lock_guard lock(mutex_);
          moment_ = moment;
          return discard_ ? FilmStep::kDiscard : finish_ ? FilmStep::kFinish : FilmStep::kGoOn;
        });
        const std::lock_guard lock(mutex_);
        outcome_ = std::move(filmed);
      }) {}

FilmTask::~FilmTask() {
  finish_ = true;
  thread_.join();
  if (discard_ && outcome_->ok()) {  // The recording was complete before it was discarded.
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
}

FilmMoment FilmTask::moment() const {
  const std::lock_guard lock(mutex_);
  return moment_;
}

std::optional<Result<Filmed>> FilmTask::outcome() const {
  const std::lock_guard lock(mutex_);
  return outcome_;
}

}  // namespace lararium::editor
