// lararium_soak SHOW.larshow VIDEO [--seconds N] [--out FILE.json]
//
// Plays a show on a recording in a loop, in the same way as the player and at the quality that the
// machine can draw. Meanwhile it injects faults into the camera, its clock, the sound device, the
// script, the disk of the log and the folder of the state. For each fault it prints how often it
// was injected; noticed (within five seconds the log has a line about it, and no image without the
// place got a pose); logged (a line reports its end as well, and there are few lines in total); and
// recovered from (within three seconds the failed part works again and people are visible). It
// fails if one of these numbers is too small, or if memory grew.

#include <fcntl.h>
#include <spdlog/logger.h>
#include <spdlog/sinks/base_sink.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "player/app/heap.h"
#include "player/kiosk/fault_log.h"
#include "player/kiosk/kiosk.h"
#include "shared/audio/sound_player.h"
#include "shared/bundle/bundle.h"
#include "shared/capture/looped_source.h"
#include "shared/capture/steady_camera.h"
#include "shared/core/json.h"
#include "shared/core/median.h"
#include "shared/core/memory.h"
#include "shared/core/random.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/quality.h"
#include "shared/show/frame_pipeline.h"
#include "shared/show/quality_controller.h"
#include "shared/show/show_renderer.h"
#include "shared/vision/pose_smoother.h"
#include "shared/vision/tracker.h"

namespace lararium {
namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr double kGoodSeconds = 7.0;
constexpr double kFaultSeconds = 4.0;
// Seconds after the end of a fault until the failed part must work again.
constexpr double kMostRecovery = 3.0;
// Seconds after the beginning and after the end of a fault until the log must have a line about it.
constexpr double kMostToTell = 5.0;
// On slow machines both limits are at least the time of this number of images, which the camera
// gives in one second.
constexpr int kFewImages = 30;
// Limit of lines in the log from the beginning of a fault until the next one.
constexpr size_t kMostLines = 16;
// Limit of the difference between the drama's time and that of images while their clock jumps: two
// images.
constexpr double kMostTimeError = 2.0 / 30.0;
constexpr double kMostGrowth = 0.02;
constexpr double kMemoryInterval = 10.0;  // seconds
constexpr int kWidth = 1280, kHeight = 720;
constexpr const char* kErrorKey = "f12";

enum class Fault {
  kUnplugged,
  kBlack,
  kCovered,
  kForeign,
  kClockJump,
  kSoundGone,
  kScriptError,
  kLogFull,
  kStateGone,
  kNone,
};
constexpr size_t kFaults = static_cast<size_t>(Fault::kNone);

struct FaultKind {
  const char* name;
  const char* begins;  // text in the log at its beginning; alternatives are separated by '|'
  const char* ends;    // text in the log at its end; nullptr: the fault ends immediately
  bool blinds = false;
};
constexpr std::array<FaultKind, kFaults> kKinds = {{
    {"camera unplugged", "waiting for it", "the camera is back", true},
    {"black frames", "the place is not found: too dark", "the place is found after", true},
    {"covered lens",
     "the place is not found: too few features|the place is not found: too few matches",
     "the place is found after", true},
    {"foreign images",
     "the place is not found: too few matches|the place is not found: no consistent",
     "the place is found after", true},
    {"clock jumps", "the camera's clock leapt", "the camera's clock is steady again"},
    {"sound device gone", "the show goes on in silence", "sound goes to"},
    {"script error", "soak: an error of the script", nullptr},
    {"log's disk full", "the log cannot be written", "is written again"},
    {"state folder gone", "after a failure the show will begin at its beginning",
     "where the show is can be kept again"},
}};

const FaultKind& KindOf(Fault fault) { return kKinds[static_cast<size_t>(fault)]; }

double Seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

// The current fault. Faults follow one another, with times without a fault in between. Only one
// thread may call MoveOn.
class Schedule {
 public:
  Fault Now() const { return now_; }
  // Updates the current fault. Returns true if it has changed.
  bool MoveOn() {
    const double cycle = kGoodSeconds + kFaultSeconds;
    const double time = Seconds(Clock::now() - start_);
    const auto number = static_cast<size_t>(time / cycle);
    const bool good = time - static_cast<double>(number) * cycle < kGoodSeconds;
    const Fault next = good ? Fault::kNone : static_cast<Fault>(number % kFaults);
    return now_.exchange(next) != next;
  }

 private:
  Clock::time_point start_ = Clock::now();
  std::atomic<Fault> now_ = Fault::kNone;
};

// Collects all messages of the log.
class LogEar final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  // True if one of the texts ("a|b") was logged between two moments.
  bool Heard(std::string_view texts, Clock::time_point from, Clock::time_point until) {
    const std::lock_guard lock(mutex_);
    while (true) {
      const size_t end = texts.find('|');
      const std::string_view text = texts.substr(0, end);
      for (const auto& [time, line] : lines_) {
        if (time >= from && time <= until && line.find(text) != std::string::npos) {
          return true;
        }
      }
      if (end == std::string_view::npos) {
        return false;
      }
      texts.remove_prefix(end + 1);
    }
  }
  size_t Count(Clock::time_point from) {
    const std::lock_guard lock(mutex_);
    return static_cast<size_t>(std::count_if(lines_.begin(), lines_.end(),
                                             [&](const auto& line) { return line.first >= from; }));
  }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    if (lines_.size() == kKept) {
      lines_.pop_front();
    }
    lines_.emplace_back(Clock::now(), std::string(message.payload.data(), message.payload.size()));
  }
  void flush_() override {}

 private:
  static constexpr size_t kKept = 500;
  std::deque<std::pair<Clock::time_point, std::string>> lines_;
};

// The true time and fault of an image, independent of its camera's clock.
struct Truth {
  double time = 0.0;  // capture time, seconds
  Fault fault = Fault::kNone;
};

// Photographs of other places; empty if the data folder does not exist.
std::vector<cv::Mat> ForeignImages(cv::Size size) {
  constexpr size_t kOfEach = 4;
  std::vector<cv::Mat> images;
  for (const char* name : {"fox-pinhole", "box", "fountain-P11"}) {
    std::error_code error;
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(fs::path(LARARIUM_DATA_DIR) / name / "images", error)) {
      files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    files.resize(std::min(files.size(), kOfEach));
    for (const fs::path& file : files) {
      const cv::Mat image = cv::imread(file.string(), cv::IMREAD_COLOR);
      if (!image.empty()) {
        cv::resize(image, images.emplace_back(), size, 0, 0, cv::INTER_AREA);
      }
    }
  }
  return images;
}

// Rearranges and flips the tiles of an image.
void Shuffle(const cv::Mat& image, cv::Mat& shuffled) {
  const int w = image.cols / 8, h = image.rows / 8;
  for (int tile = 0; tile < 64; ++tile) {
    const int from = (tile * 37 + 11) % 64;
    cv::Mat piece;
    cv::flip(image(cv::Rect(from % 8 * w, from / 8 * h, w, h)), piece, tile % 3 - 1);
    piece.copyTo(shuffled(cv::Rect(tile % 8 * w, tile / 8 * h, w, h)));
  }
}

// A camera that plays a recording and has the faults of real cameras.
class FaultyCamera final : public capture::FrameSource {
 public:
  FaultyCamera(std::shared_ptr<capture::FrameSource> recording,
               const std::vector<cv::Mat>& foreign,
               const Schedule& schedule,
               Truth& truth)
      : recording_(std::move(recording)), foreign_(foreign), schedule_(schedule), truth_(truth) {}

  Result<std::optional<geometry::Frame>> Next() override {
    if (schedule_.Now() == Fault::kUnplugged) {
      return Status::Error("camera 0", "gives no image", "check that it is connected");
    }
    LARARIUM_ASSIGN_OR_RETURN(std::optional<geometry::Frame> frame, recording_->Next());
    if (!frame) {
      return frame;
    }
    Wait();
    truth_ = {Seconds(Clock::now().time_since_epoch()), schedule_.Now()};
    frame->capture_time = Seconds(Clock::now() - start_);
    if (truth_.fault == Fault::kClockJump) {
      frame->capture_time += 1000.0 * static_cast<double>(frame->index / 40 % 3) - 500.0;
    } else if (truth_.fault != Fault::kNone && KindOf(truth_.fault).blinds) {
      Spoil(truth_.fault, *frame);
    }
    return frame;
  }
  Status Seek(int64_t) override { return Status::Error("camera 0", "cannot seek"); }
  std::optional<int64_t> frame_count() const override { return std::nullopt; }
  int width() const override { return recording_->width(); }
  int height() const override { return recording_->height(); }
  double frames_per_second() const override { return recording_->frames_per_second(); }
  bool live() const override { return true; }
  std::string FrameName(int64_t index) const override { return recording_->FrameName(index); }

 private:
  // Waits until the next image is due.
  void Wait() {
    next_ += std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(1.0 / frames_per_second()));
    next_ = std::max(next_, Clock::now() - std::chrono::milliseconds(100));
    std::this_thread::sleep_until(next_);
  }

  void Spoil(Fault fault, geometry::Frame& frame) {
    cv::Mat bgr = frame.bgr.clone();
    if (fault == Fault::kBlack) {
      bgr.setTo(0);
    } else if (fault == Fault::kCovered) {
      cv::randn(bgr, cv::Scalar::all(45.0), cv::Scalar::all(5.0));  // light through a hand
    } else if (foreign_.empty()) {
      Shuffle(frame.bgr, bgr);
    } else {
      foreign_[static_cast<size_t>(frame.index / 15) % foreign_.size()].copyTo(bgr);
    }
    frame.bgr = bgr;
    cv::cvtColor(bgr, frame.grey, cv::COLOR_BGR2GRAY);
  }

  std::shared_ptr<capture::FrameSource> recording_;
  const std::vector<cv::Mat>& foreign_;
  const Schedule& schedule_;
  Truth& truth_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = Clock::now();
};

// The source for the pipeline. It wraps the steady camera and stores the truth of each image.
class KnownSource final : public capture::FrameSource {
 public:
  KnownSource(std::unique_ptr<capture::FrameSource> steady, Truth& truth)
      : steady_(std::move(steady)), truth_(truth), truths_(kKept) {}

  Result<std::optional<geometry::Frame>> Next() override {
    truth_ = {NAN, Fault::kUnplugged};  // the camera overwrites it if it gives an image
    Result<std::optional<geometry::Frame>> frame = steady_->Next();
    if (frame.ok() && frame->has_value()) {
      const std::lock_guard lock(mutex_);
      truths_[static_cast<size_t>((*frame)->index) % kKept] = truth_;
    }
    return frame;
  }
  // The truth of one of the last images.
  Truth Of(int64_t index) const {
    const std::lock_guard lock(mutex_);
    return truths_[static_cast<size_t>(index) % kKept];
  }
  Status Seek(int64_t index) override { return steady_->Seek(index); }
  std::optional<int64_t> frame_count() const override { return steady_->frame_count(); }
  int width() const override { return steady_->width(); }
  int height() const override { return steady_->height(); }
  double frames_per_second() const override { return steady_->frames_per_second(); }
  bool live() const override { return true; }
  std::string FrameName(int64_t index) const override { return steady_->FrameName(index); }

 private:
  static constexpr size_t kKept = 1000;
  std::unique_ptr<capture::FrameSource> steady_;
  Truth& truth_;  // belongs to the reading thread
  mutable std::mutex mutex_;
  std::vector<Truth> truths_;
};

// Statistics of the sound device since it was last opened.
struct Played {
  std::atomic<int> openings = 0;
  std::atomic<int> blocks = 0;
  std::atomic<int> audible = 0;  // blocks that are not silence
  std::atomic<int> wrong = 0;    // samples that are not finite, since the start of the program
};

// A sound device that can be pulled out.
class FaultySound final : public audio::AudioOut {
 public:
  FaultySound(std::unique_ptr<audio::AudioOut> out, const Schedule& schedule, Played& played)
      : out_(std::move(out)), schedule_(schedule), played_(played) {
    ++played_.openings;
    played_.blocks = 0;
    played_.audible = 0;
  }
  Status Write(std::span<const float> stereo) override {
    if (schedule_.Now() == Fault::kSoundGone) {
      return Status::Error("sound", "the device is gone");
    }
    ++played_.blocks;
    played_.audible +=
        std::any_of(stereo.begin(), stereo.end(), [](float s) { return s != 0.0f; }) ? 1 : 0;
    played_.wrong += static_cast<int>(
        std::count_if(stereo.begin(), stereo.end(), [](float s) { return !std::isfinite(s); }));
    return out_->Write(stereo);
  }
  double latency() const override { return out_->latency(); }
  Status Finish() override { return out_->Finish(); }
  std::string name() const override { return "a double"; }

 private:
  std::unique_ptr<audio::AudioOut> out_;
  const Schedule& schedule_;
  Played& played_;
};

// The folder for files that the player writes, and faults of its disk. The destructor removes it.
class Disk {
 public:
  Disk() : folder_(fs::temp_directory_path() / ("lararium_soak." + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Disk() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Disk(const Disk&) = delete;
  Disk& operator=(const Disk&) = delete;

  fs::path log() const { return folder_ / "log.txt"; }
  fs::path state() const { return folder_ / "state"; }

  // Redirects every open descriptor of the log to a full disk.
  void FillLog() const { Redirect(log(), "/dev/full"); }
  void FreeLog() const { Redirect("/dev/full", log()); }
  // Replaces the folder by a file, so that nothing can be written (not even by root).
  void TakeState() const {
    fs::rename(state(), folder_ / "away");
    std::ofstream(state()) << "not a folder";
  }
  void GiveStateBack() const {
    fs::remove(state());
    fs::rename(folder_ / "away", state());
  }

  bool LogHas(std::string_view text) const {
    std::ifstream file(log());
    const std::string all((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    return all.find(text) != std::string::npos;
  }
  bool StateWrittenSince(fs::file_time_type time) const {
    std::error_code error;
    const fs::file_time_type written = fs::last_write_time(state() / "state.json", error);
    return !error && written > time && player::LoadKioskState(state()).ok();
  }

 private:
  static void Redirect(const fs::path& from, const fs::path& to) {
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc/self/fd")) {
      std::error_code error;
      if (fs::read_symlink(entry.path(), error) == from) {
        const int target = open(to.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        dup3(target, std::stoi(entry.path().filename().string()), O_CLOEXEC);
        close(target);
        return;
      }
    }
  }

  fs::path folder_;
};

struct Outcome {
  int injected = 0;
  int noticed = 0;
  int logged = 0;
  int recovered = 0;
  double longest = 0.0;   // longest time of recovery, seconds
  size_t most_lines = 0;  // largest number of lines in the log
};

struct Options {
  std::string show;
  std::string video;
  double seconds = 60.0;
  std::string out;
};

// Everything that the judge observes.
struct Scene {
  const Schedule& schedule;
  const KnownSource& source;
  const Played& played;
  const Disk& disk;
  LogEar& ear;
};

// Decides for each fault whether it was noticed, logged and recovered from.
class Judge {
 public:
  explicit Judge(const Scene& scene) : scene_(scene) {}

  // Call this when a fault has just begun.
  void Begin() {
    Settle();
    fault_ = scene_.schedule.Now();
    begun_ = Clock::now();
    told_until_ = begun_ + kToTell;
    images_ = 0;
    ended_.reset();
    recovered_.reset();
    time_error_ = 0.0;
    posed_blind_ = false;
  }
  // Call this when the fault has just ended.
  void End() {
    ended_ = Clock::now();
    end_told_until_ = *ended_ + kToTell;
    images_since_end_ = 0;
    tracked_since_end_ = 0;
    ended_on_disk_ = fs::file_time_type::clock::now();
    end_text_ = "soak: the end of fault " + std::to_string(++ends_);
  }
  // The line that is logged at the end of a fault and must then be in the log's file.
  const std::string& end_text() const { return end_text_; }

  void Frame(const show::StagedFrame& staged) {
    const Truth truth = scene_.source.Of(staged.tracked.frame.index);
    const bool tracked = staged.tracked.camera_from_map.has_value();
    CountImage();
    // People must not be visible in a place that no image shows. They have faded out half a second
    // after the hold time.
    if (!tracked && staged.camera.lost_seconds > 1.0 && staged.camera.opacity > 0.0f) {
      ++ghosts_;
    }
    if (truth.fault != Fault::kNone && KindOf(truth.fault).blinds && tracked) {
      posed_blind_ = true;
      ++ghosts_;
    }
    FollowTime(truth, staged.time);
    tracked_since_end_ += tracked ? 1 : 0;
    opacity_ = staged.camera.opacity;
    const bool shows = tracked && staged.camera.opacity > 0.99f && truth.fault == Fault::kNone;
    if (fault_ != Fault::kNone && ended_ && !recovered_ && shows && WorksAgain(staged)) {
      recovered_ = Seconds(Clock::now() - *ended_);
      recovered_in_time_ = *recovered_ <= kMostRecovery || images_since_end_ <= kFewImages;
    }
  }
  // Evaluates the last fault, unless it is too recent to judge.
  void Settle() {
    if (fault_ == Fault::kNone || !ended_ || Seconds(Clock::now() - *ended_) < kMostToTell) {
      return;
    }
    const FaultKind& kind = KindOf(fault_);
    Outcome& outcome = outcomes_[static_cast<size_t>(fault_)];
    const size_t lines = scene_.ear.Count(begun_);
    const bool begin_told = scene_.ear.Heard(kind.begins, begun_, told_until_);
    const bool end_told =
        kind.ends == nullptr || scene_.ear.Heard(kind.ends, *ended_, end_told_until_);
    ++outcome.injected;
    outcome.noticed += begin_told && !posed_blind_ ? 1 : 0;
    outcome.logged += begin_told && end_told && lines <= kMostLines ? 1 : 0;
    outcome.recovered += recovered_ && recovered_in_time_ ? 1 : 0;
    if (!recovered_ || !recovered_in_time_) {
      std::printf(
          "not recovered from in time: %s, after %.2f s; %d images since, %d of them with a "
          "pose; people are seen by a share of %.2f now\n",
          kind.name, recovered_.value_or(INFINITY), images_since_end_, tracked_since_end_,
          opacity_);
    }
    outcome.longest = std::max(outcome.longest, recovered_.value_or(INFINITY));
    outcome.most_lines = std::max(outcome.most_lines, lines);
    fault_ = Fault::kNone;
  }
  const std::array<Outcome, kFaults>& outcomes() const { return outcomes_; }
  int ghosts() const { return ghosts_; }
  double worst_time_error() const { return worst_time_error_; }

 private:
  void CountImage() {
    const Clock::time_point now = Clock::now();
    if (++images_ <= kFewImages) {
      told_until_ = std::max(told_until_, now);
    }
    if (++images_since_end_ <= kFewImages) {
      end_told_until_ = std::max(end_told_until_, now);
    }
  }

  // Measures how far the drama's time has moved from that of images since before the fault.
  void FollowTime(const Truth& truth, double drama_time) {
    const bool back = last_drama_time_ > drama_time;
    last_drama_time_ = drama_time;
    if (!std::isfinite(truth.time)) {
      return;
    }
    double error = back ? INFINITY : std::abs(drama_time - truth.time - reference_);
    if (fault_ != Fault::kClockJump || (error > kMostTimeError && BegunAnew())) {
      reference_ = drama_time - truth.time;
      error = 0.0;
    }
    time_error_ = std::max(time_error_, error);
    worst_time_error_ = std::max(worst_time_error_, error);
  }
  // True if the show was restarted for a new visitor.
  bool BegunAnew() const { return scene_.ear.Heard("a visitor came", begun_, Clock::now()); }

  bool WorksAgain(const show::StagedFrame& staged) const {
    switch (fault_) {
      case Fault::kClockJump:
        return time_error_ <= kMostTimeError;
      case Fault::kSoundGone:
        return scene_.played.blocks > 10 &&
               (scene_.played.audible > 0 || staged.sound.voices.empty());
      case Fault::kLogFull:
        return scene_.disk.LogHas(end_text_);
      case Fault::kStateGone:
        return scene_.disk.StateWrittenSince(ended_on_disk_);
      default:
        return true;
    }
  }

  static constexpr Clock::duration kToTell =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kMostToTell));

  Scene scene_;
  Fault fault_ = Fault::kNone;
  Clock::time_point begun_;
  Clock::time_point told_until_;  // deadline for the log's line about the beginning
  int images_ = 0;                // number of images since the beginning
  std::optional<Clock::time_point> ended_;
  Clock::time_point end_told_until_;
  int images_since_end_ = 0;
  int tracked_since_end_ = 0;
  float opacity_ = 0.0f;
  fs::file_time_type ended_on_disk_;
  std::string end_text_;
  int ends_ = 0;
  std::optional<double> recovered_;  // seconds from the end of the fault to recovery
  bool recovered_in_time_ = false;
  bool posed_blind_ = false;
  double reference_ = 0.0;
  double last_drama_time_ = 0.0;
  double time_error_ = 0.0;
  double worst_time_error_ = 0.0;
  std::array<Outcome, kFaults> outcomes_;
  int ghosts_ = 0;
};

// Injects and removes the faults that the fake devices do not produce themselves.
void Inject(const Schedule& schedule,
            Fault before,
            const Disk& disk,
            Judge& judge,
            show::Show& show,
            Log& log) {
  const Fault now = schedule.Now();
  if (before == Fault::kLogFull) {
    disk.FreeLog();
  } else if (before == Fault::kStateGone) {
    disk.GiveStateBack();
  }
  if (now == Fault::kNone) {
    judge.End();
    log.Info("{}", judge.end_text());
    return;
  }
  judge.Begin();
  if (now == Fault::kLogFull) {
    disk.FillLog();
  } else if (now == Fault::kStateGone) {
    disk.TakeState();
  } else if (now == Fault::kScriptError) {
    show.input().PressKey(kErrorKey);
  }
  log.Info("soak: {}", KindOf(now).name);
}

// Medians of memory over one minute, after warming up and at the end. The median ignores memory
// that is used only briefly, for example for relocalisation.
std::pair<double, double> WarmAndLast(const std::vector<double>& memory, double warm_seconds) {
  constexpr size_t kMinute = 6;
  const size_t warm =
      std::min(static_cast<size_t>(warm_seconds / kMemoryInterval), memory.size() - 1);
  const size_t count = std::min(kMinute, memory.size() - warm);
  const auto median = [&](size_t first) {
    const auto begin = memory.begin() + static_cast<std::ptrdiff_t>(first);
    return Median(std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count)));
  };
  return {median(warm), median(memory.size() - count)};
}

std::string WithErrors(std::string drama) {
  return drama + R"(
local soak_main = main
function main()
  start(function()
    while true do
      wait_for(key(")" +
         kErrorKey + R"("))
      start(function() error("soak: an error of the script") end)
    end
  end)
  if soak_main then soak_main() end
end
)";
}

// Loads a show in the same way as the player.
Result<show::ShowContent> Load(const std::string& file) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(file));
  LARARIUM_ASSIGN_OR_RETURN(
      show::ShowContent content,
      show::LoadShowContent(bundle, {}, {},
                            show::FinestDetail(render::QualityLadder().back(), kWidth)));
  content.drama = WithErrors(std::move(content.drama));
  return content;
}

// Prints the table. Returns true if all faults were handled.
bool Report(const std::array<Outcome, kFaults>& outcomes, Json& rows) {
  bool good = true;
  std::printf(
      "| fault | injected | noticed | logged | recovered | longest, s | lines at most |\n"
      "|---|---|---|---|---|---|---|\n");
  for (size_t i = 0; i < kFaults; ++i) {
    const Outcome& outcome = outcomes[i];
    std::printf("| %s | %d | %d | %d | %d | %.2f | %zu |\n", kKinds[i].name, outcome.injected,
                outcome.noticed, outcome.logged, outcome.recovered, outcome.longest,
                outcome.most_lines);
    rows.push_back({{"fault", kKinds[i].name},
                    {"injected", outcome.injected},
                    {"noticed", outcome.noticed},
                    {"logged", outcome.logged},
                    {"recovered", outcome.recovered},
                    {"longest_s", outcome.longest},
                    {"lines_at_most", outcome.most_lines}});
    good = good && outcome.noticed == outcome.injected && outcome.logged == outcome.injected &&
           outcome.recovered == outcome.injected;
  }
  return good;
}

Result<bool> Soak(const Options& options) {
  const Disk disk;
  LARARIUM_ASSIGN_OR_RETURN(const std::shared_ptr<Log> log, MakeLog(disk.log()));
  const auto ear = std::make_shared<LogEar>();
  log->logger().sinks().push_back(ear);
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, Load(options.show));
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<capture::FrameSource> video,
                            capture::OpenVideo(options.video));
  const std::shared_ptr<capture::FrameSource> recording = capture::Loop(std::move(video));
  LARARIUM_ASSIGN_OR_RETURN(
      const geometry::CameraModel camera,
      content.places[0].map->camera.ForImages(recording->width(), recording->height()));
  vision::TrackerOptions tracking;
  tracking.background = vision::BackgroundWork::kFree;
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<vision::PoseSource> poses,
                            vision::CreateTracker(show::Maps(content.places), camera, tracking));
  show::SetOccluders(content.places, *poses);
  poses = vision::Smooth(std::move(poses), show::Maps(content.places), vision::Smoothing::kSoft);
  drama::DramaOptions drama;
  drama.past = drama::Past::kForgotten;
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<show::Show> show,
                            show::Show::Create(std::move(content), drama, *log));
  show->SetTrackingLossFader({});
  show->detail().SetPictureSize(kWidth, kHeight);
  LARARIUM_ASSIGN_OR_RETURN(const render::OffscreenContext context,
                            render::CreateOffscreenContext());
  LARARIUM_ASSIGN_OR_RETURN(
      const std::unique_ptr<show::ShowRenderer> renderer,
      show::ShowRenderer::Create(show->content(), render::QualityLadder().back()));
  LARARIUM_ASSIGN_OR_RETURN(const render::RenderTarget target,
                            render::RenderTarget::Create(kWidth, kHeight));

  player::BeginPlaying();
  const HeapKeeper heap_keeper(player::kKeepInterval);

  Schedule schedule;
  player::FaultLog faults(*log);
  Truth truth;
  const std::vector<cv::Mat> foreign = ForeignImages({recording->width(), recording->height()});
  std::atomic<int> losses = 0;
  const auto make = [&]() -> std::unique_ptr<capture::FrameSource> {
    return std::make_unique<FaultyCamera>(recording, foreign, schedule, truth);
  };
  const auto open = [&]() -> Result<std::unique_ptr<capture::FrameSource>> {
    if (schedule.Now() == Fault::kUnplugged) {
      return Status::Error("camera 0", "cannot be opened");
    }
    return make();
  };
  KnownSource source(capture::MakeSteady(make(), capture::RealWorld(
                                                     open,
                                                     [&](bool connected, const std::string& why) {
                                                       losses += connected ? 1 : 0;
                                                       faults.CameraChanged(connected, why);
                                                     },
                                                     [&](bool steady, double leap) {
                                                       faults.ClockChanged(steady, leap);
                                                     })),
                     truth);
  Played played;
  std::unique_ptr<audio::SoundPlayer> sound;
  if (auto mixer = audio::Mixer::Create(show->sounds(), {}); mixer.ok()) {
    sound = std::make_unique<audio::SoundPlayer>(
        std::move(*mixer),
        [&]() -> Result<std::unique_ptr<audio::AudioOut>> {
          if (schedule.Now() == Fault::kSoundGone) {
            return Status::Error("sound", "no device");
          }
          LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<audio::AudioOut> none,
                                    audio::CreateAudioOut(audio::AudioOutKind::kNone));
          return std::unique_ptr<audio::AudioOut>(
              std::make_unique<FaultySound>(std::move(none), schedule, played));
        },
        *log);
  }
  player::Kiosk kiosk(disk.state(), {}, *log);
  Judge judge({schedule, source, played, disk, *ear});

  const std::span<const render::Quality> fader = render::QualityLadder();
  show::QualityController quality(
      show::QualityOptions::ForCamera(fader.size(), recording->frames_per_second()),
      fader.size() - 1);
  renderer->SetQuality(fader.back());
  show->detail().SetQuality(fader.back());
  show::ShowStatistics statistics;
  std::vector<double> memory = {show::ResidentMebibytes()};
  const Clock::time_point begin = Clock::now();
  const double warm_seconds = std::min(300.0, 0.5 * options.seconds);
  {
    show::RealtimePipeline pipeline({source, *poses, *show, statistics});
    double elapsed = 0.0;
    while (elapsed < options.seconds) {
      elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
      if (elapsed >= static_cast<double>(memory.size()) * kMemoryInterval) {
        memory.push_back(show::ResidentMebibytes());
      }
      const Fault before = schedule.Now();
      if (schedule.MoveOn()) {
        Inject(schedule, before, disk, judge, *show, *log);
      }
      std::unique_ptr<show::StagedFrame> staged = pipeline.Take(std::chrono::milliseconds(20));
      if (staged == nullptr) {
        continue;
      }
      const Clock::time_point drawing = Clock::now();
      LARARIUM_RETURN_IF_ERROR(renderer->Draw(*staged, target));
      target.Finish();
      const double draw_ms =
          std::chrono::duration<double, std::milli>(Clock::now() - drawing).count();
      if (staged->camera.camera_from_stage &&
          quality.AddFrame(elapsed, std::max(draw_ms, staged->times.stage_ms))) {
        renderer->SetQuality(fader[quality.level()]);
        show->detail().SetQuality(fader[quality.level()]);
      }
      if (sound != nullptr) {
        sound->Show(staged->sound);
      }
      faults.AfterFrame(staged->tracked);
      judge.Frame(*staged);
      kiosk.AfterFrame(elapsed, *staged, *show);
      pipeline.Recycle(std::move(staged));
    }
    pipeline.Stop();
    LARARIUM_RETURN_IF_ERROR(pipeline.status());
  }
  judge.Settle();

  Json rows = Json::array();
  bool good = Report(judge.outcomes(), rows) && judge.ghosts() == 0 && played.wrong == 0;
  const auto [warm_mib, last_mib] = WarmAndLast(memory, warm_seconds);
  const double growth = last_mib / warm_mib - 1.0;
  statistics.quality = quality.ToJson();
  const Json tracking_json = statistics.ToJson();
  std::printf("frames at each level of quality:");
  for (const int64_t frames : quality.frames()) {
    std::printf(" %lld", static_cast<long long>(frames));
  }
  std::printf("\n");
  std::printf(
      "%.0f s, %lld frames, camera came back %d times, sound opened %d times; the drama's time at "
      "most %.3f s off while the camera's clock leapt; %zu foreign images; memory %.0f MiB after "
      "%.0f s, %.0f MiB at the end (%+.1f %%); %d frames with "
      "people where none should be\n",
      options.seconds, static_cast<long long>(statistics.tracking.frames()), losses.load(),
      played.openings.load(), judge.worst_time_error(), foreign.size(), warm_mib, warm_seconds,
      last_mib, 100.0 * growth, judge.ghosts());
  if (!options.out.empty()) {
    LARARIUM_RETURN_IF_ERROR(SaveJson(options.out, {{"faults", rows},
                                                    {"memory_warm_mib", warm_mib},
                                                    {"memory_end_mib", last_mib},
                                                    {"memory_every_10_s_mib", memory},
                                                    {"time_error_s", judge.worst_time_error()},
                                                    {"foreign_images", foreign.size()},
                                                    {"ghosts", judge.ghosts()},
                                                    {"statistics", tracking_json}}));
  }
  if (options.seconds >= 600.0 && growth > kMostGrowth) {
    std::printf("memory grew\n");
    good = false;
  }
  return good;
}

}  // namespace
}  // namespace lararium

int main(int argc, char** argv) {
  lararium::player::BeginLoading();
  lararium::Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--seconds" && i + 1 < argc) {
      options.seconds = std::atof(argv[++i]);
    } else if (word == "--out" && i + 1 < argc) {
      options.out = argv[++i];
    } else if (options.show.empty()) {
      options.show = word;
    } else {
      options.video = word;
    }
  }
  if (options.show.empty() || options.video.empty()) {
    std::fprintf(stderr, "lararium_soak SHOW.larshow VIDEO [--seconds N] [--out FILE.json]\n");
    return 2;
  }
  const auto good = lararium::Soak(options);
  if (!good.ok()) {
    std::fprintf(stderr, "%s\n", good.message().c_str());
    return 1;
  }
  return *good ? 0 : 1;
}
