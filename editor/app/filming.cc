#include "editor/app/filming.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "editor/app/text.h"
#include "editor/train/corner_tracker.h"
#include "shared/capture/video_writer.h"

namespace lararium::app {

namespace {

using train::CoverageAdvice;
using train::CoverageFault;

// A recording whose frames come when they were taken.
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
  Status Seek(int64_t) override { return Status::Error("camera", "cannot be sought"); }
  std::optional<int64_t> frame_count() const override { return std::nullopt; }
  int width() const override { return recording_->width(); }
  int height() const override { return recording_->height(); }
  double frames_per_second() const override { return recording_->frames_per_second(); }
  bool live() const override { return true; }
  std::string FrameName(int64_t index) const override { return recording_->FrameName(index); }

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

Result<FilmMoment> Film(capture::FrameSource& camera,
                        const std::filesystem::path& file,
                        const std::function<FilmStep(const FilmMoment&)>& next) {
  LARARIUM_RETURN_IF_ERROR(MakeFolderOf(file));
  // The encoder takes even sizes only: at most one row and column are lost.
  const cv::Rect even(0, 0, camera.width() & ~1, camera.height() & ~1);
  const double rate = camera.frames_per_second();
  LARARIUM_ASSIGN_OR_RETURN(const auto writer,
                            capture::VideoWriter::Create(file, even.width, even.height, rate));
  const geometry::CameraModel model = train::TypicalCamera(camera.width(), camera.height());
  train::CornerTracker tracker(model);
  train::CoverageGuide guide(train::HalfView(model));
  FilmMoment moment;
  std::optional<double> first_time;
  int64_t index = -1;
  while (true) {
    LARARIUM_ASSIGN_OR_RETURN(const auto frame, camera.Next());
    if (!frame) {
      break;
    }
    first_time = first_time.value_or(frame->capture_time);
    moment.seconds = frame->capture_time - *first_time;
    // A frame that the camera dropped leaves its time to the one before.
    index = std::max<int64_t>(index + 1, std::llround(moment.seconds * rate));
    LARARIUM_RETURN_IF_ERROR(writer->Write(frame->bgr(even), index));
    moment.coverage = guide.Add(tracker.Measure(frame->grey, moment.seconds));
    moment.cells = guide.cells();
    moment.bgr = std::make_shared<const cv::Mat>(frame->bgr.clone());
    ++moment.frames;
    const FilmStep step = next(moment);
    if (step == FilmStep::kDiscard) {
      return Status::Error(file.string(), "recording was cancelled");
    }
    if (step == FilmStep::kFinish) {
      break;
    }
  }
  if (moment.frames == 0) {
    return Status::Error("the camera", "gave no image", "look whether another program has it");
  }
  LARARIUM_RETURN_IF_ERROR(writer->Finish());
  return moment;
}

std::filesystem::path NewFilmFile(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (int number = 1;; ++number) {
    std::filesystem::path file = folder / ("film-" + std::to_string(number) + ".mp4");
    if (!std::filesystem::exists(file, ignored)) {
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

Json CoverageJson(const train::CoverageState& coverage) {
  return {{"covered", coverage.shares.all()}, {"ahead", coverage.shares.ahead},
          {"floor", coverage.shares.floor},   {"sideways", coverage.shares.sideways},
          {"depth", coverage.shares.depth},   {"advice", AdviceText(coverage.advice, false)}};
}

FilmTask::FilmTask(std::unique_ptr<capture::FrameSource> camera, std::filesystem::path file)
    : file_(std::move(file)),
      thread_([this, camera = std::shared_ptr<capture::FrameSource>(std::move(camera))] {
        const Result<FilmMoment> last = Film(*camera, file_, [this](const FilmMoment& moment) {
          const std::lock_guard lock(mutex_);
          moment_ = moment;
          return finish_ ? FilmStep::kFinish : discard_ ? FilmStep::kDiscard : FilmStep::kGoOn;
        });
        const std::lock_guard lock(mutex_);
        outcome_ = last.status();
      }) {}

FilmTask::~FilmTask() {
  discard_ = true;
  thread_.join();
  if (!finish_ && outcome_->ok()) {  // the recording had ended by itself
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
  }
}

FilmMoment FilmTask::moment() const {
  const std::lock_guard lock(mutex_);
  return moment_;
}

std::optional<Status> FilmTask::outcome() const {
  const std::lock_guard lock(mutex_);
  return outcome_;
}

}  // namespace lararium::app
