// lararium_soak SHOW.larshow VIDEO [--seconds N] [--out FILE.json]
//
// Plays a show in a loop as the player does, on a recording, as fine as the machine is quick
// enough for, and injects faults at the seams where the world comes in: the camera, its clock,
// the sound device, the script, the log's disk.
// Says of each how often it was injected, how it was noticed, and how long it took until people
// were seen again. Fails where a fault was not recovered from, or memory grew.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "player/heap.h"
#include "player/kiosk.h"
#include "shared/audio/sound_player.h"
#include "shared/bundle/bundle.h"
#include "shared/capture/looped_source.h"
#include "shared/capture/steady_camera.h"
#include "shared/core/json.h"
#include "shared/core/median.h"
#include "shared/core/random.h"
#include "shared/render/graphics_context.h"
#include "shared/render/quality.h"
#include "shared/show/frame_pipeline.h"
#include "shared/show/quality_controller.h"
#include "shared/show/show_renderer.h"
#include "shared/vision/pose_smoother.h"
#include "shared/vision/tracker.h"

namespace lararium {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kGoodSeconds = 7.0;
constexpr double kFaultSeconds = 4.0;
// After a fault has ended, until people must be seen again.
constexpr double kMostRecovery = 3.0;
constexpr double kMostGrowth = 0.02;
constexpr double kMemoryInterval = 10.0;  // seconds
constexpr double kScriptErrorSeconds = 15.0;
constexpr int kWidth = 1280, kHeight = 720;

enum class Fault { kNone, kUnplugged, kBlack, kCovered, kForeign, kClockJump, kSoundGone };
constexpr Fault kFaults[] = {Fault::kUnplugged, Fault::kBlack,     Fault::kCovered,
                             Fault::kForeign,   Fault::kClockJump, Fault::kSoundGone};

const char* Name(Fault fault) {
  switch (fault) {
    case Fault::kNone:
      return "none";
    case Fault::kUnplugged:
      return "camera unplugged";
    case Fault::kBlack:
      return "black frames";
    case Fault::kCovered:
      return "covered lens";
    case Fault::kForeign:
      return "foreign images";
    case Fault::kClockJump:
      return "clock jumps";
    case Fault::kSoundGone:
      return "sound device gone";
  }
  return "";
}

// Which fault there is now: one after the other, with good times between.
class Schedule {
 public:
  Fault Now() const {
    const double cycle = kGoodSeconds + kFaultSeconds;
    const double time = std::chrono::duration<double>(Clock::now() - start_).count();
    const auto number = static_cast<size_t>(time / cycle);
    const bool good = time - static_cast<double>(number) * cycle < kGoodSeconds;
    return good ? Fault::kNone : kFaults[number % std::size(kFaults)];
  }

 private:
  Clock::time_point start_ = Clock::now();
};

// A camera that plays a recording, and everything that happens to cameras.
class FaultyCamera final : public capture::FrameSource {
 public:
  FaultyCamera(std::shared_ptr<capture::FrameSource> recording, const Schedule& schedule)
      : recording_(std::move(recording)), schedule_(schedule) {}

  Result<std::optional<geometry::Frame>> Next() override {
    const Fault fault = schedule_.Now();
    if (fault == Fault::kUnplugged) {
      return Status::Error("camera 0", "gives no image", "check that it is connected");
    }
    LARARIUM_ASSIGN_OR_RETURN(std::optional<geometry::Frame> frame, recording_->Next());
    if (!frame) {
      return frame;
    }
    Wait();
    frame->capture_time = std::chrono::duration<double>(Clock::now() - start_).count();
    if (fault == Fault::kClockJump) {
      frame->capture_time += 1000.0 * static_cast<double>(frame->index / 40 % 3) - 500.0;
    } else if (fault != Fault::kNone && fault != Fault::kSoundGone) {
      Spoil(fault, *frame);
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
  // A camera gives images at its rate.
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
    } else {
      // Another place: the image's tiles in another order, turned over.
      const int w = bgr.cols / 8, h = bgr.rows / 8;
      for (int tile = 0; tile < 64; ++tile) {
        const int from = (tile * 37 + 11) % 64;
        cv::Mat piece;
        cv::flip(frame.bgr(cv::Rect(from % 8 * w, from / 8 * h, w, h)), piece, tile % 3 - 1);
        piece.copyTo(bgr(cv::Rect(tile % 8 * w, tile / 8 * h, w, h)));
      }
    }
    frame.bgr = bgr;
    cv::cvtColor(bgr, frame.grey, cv::COLOR_BGR2GRAY);
  }

  std::shared_ptr<capture::FrameSource> recording_;
  const Schedule& schedule_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = Clock::now();
};

// A sound device that can be pulled out.
class FaultySound final : public audio::AudioOut {
 public:
  FaultySound(std::unique_ptr<audio::AudioOut> out, const Schedule& schedule)
      : out_(std::move(out)), schedule_(schedule) {}
  Status Write(std::span<const float> stereo) override {
    if (schedule_.Now() == Fault::kSoundGone) {
      return Status::Error("sound", "the device is gone");
    }
    return out_->Write(stereo);
  }
  double latency() const override { return out_->latency(); }
  Status Finish() override { return out_->Finish(); }
  std::string name() const override { return "a double"; }

 private:
  std::unique_ptr<audio::AudioOut> out_;
  const Schedule& schedule_;
};

struct Outcome {
  int injected = 0;
  int noticed = 0;       // frames that said so, or log lines
  int recovered = 0;     // people were seen again in time
  double longest = 0.0;  // seconds until then
};

struct Options {
  std::string show;
  std::string video;
  double seconds = 60.0;
  std::string out;
};

// What happened, fault by fault.
class Judge {
 public:
  explicit Judge(const Schedule& schedule) : schedule_(schedule) {}

  void Frame(const show::StagedFrame& staged) {
    const Clock::time_point now = Clock::now();
    const Fault fault = schedule_.Now();
    const bool tracked = staged.tracked.camera_from_map.has_value();
    if (fault != fault_) {
      if (fault != Fault::kNone) {
        Settle();
        ++outcomes_[fault].injected;
      } else {
        waiting_for_ = fault_;
        ended_ = now;
      }
      fault_ = fault;
    }
    const bool shows = tracked && staged.opacity > 0.99f;
    if (fault != Fault::kNone && (!tracked || fault == Fault::kClockJump)) {
      ++outcomes_[fault].noticed;
    }
    if (waiting_for_ != Fault::kNone && shows) {
      Outcome& outcome = outcomes_[waiting_for_];
      const double seconds = std::chrono::duration<double>(now - ended_).count();
      outcome.longest = std::max(outcome.longest, seconds);
      outcome.recovered += seconds <= kMostRecovery ? 1 : 0;
      waiting_for_ = Fault::kNone;
    }
    // Never people in a place that no image shows: they have gone half a second after the hold.
    if (!tracked && staged.lost_seconds > 1.0 && staged.opacity > 0.0f) {
      ++ghosts_;
    }
  }
  // The last fault may not have been waited for.
  void Settle() {
    if (waiting_for_ != Fault::kNone) {
      outcomes_[waiting_for_].longest = INFINITY;
      waiting_for_ = Fault::kNone;
    }
  }
  void ForgetLast() {
    if (waiting_for_ != Fault::kNone || fault_ != Fault::kNone) {
      --outcomes_[waiting_for_ != Fault::kNone ? waiting_for_ : fault_].injected;
    }
  }
  std::map<Fault, Outcome>& outcomes() { return outcomes_; }
  int ghosts() const { return ghosts_; }

 private:
  const Schedule& schedule_;
  Fault fault_ = Fault::kNone;
  Fault waiting_for_ = Fault::kNone;
  Clock::time_point ended_;
  std::map<Fault, Outcome> outcomes_;
  int ghosts_ = 0;
};

// Medians of a minute each, from when it is warm and at the end: what is taken for a moment, by
// places that are looked for again, does not count.
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
      wait()" +
         std::to_string(kScriptErrorSeconds) + R"()
      start(function() error("soak: an error of the script") end)
    end
  end)
  if soak_main then soak_main() end
end
)";
}

// As the player has it.
Result<show::ShowContent> Load(const std::string& file) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(file));
  LARARIUM_ASSIGN_OR_RETURN(
      show::ShowContent content,
      show::LoadShowContent(bundle, {}, {},
                            show::FinestDetail(render::QualityLadder().back(), kWidth)));
  content.drama = WithErrors(std::move(content.drama));
  return content;
}

Result<bool> Soak(const Options& options) {
  // A log whose disk is full.
  LARARIUM_ASSIGN_OR_RETURN(const std::shared_ptr<Log> log, MakeLog("/dev/full"));
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
  show->SetLostLadder({});
  show->SetPictureSize(kWidth, kHeight);
  LARARIUM_ASSIGN_OR_RETURN(const render::OffscreenContext context,
                            render::CreateOffscreenContext());
  LARARIUM_ASSIGN_OR_RETURN(
      const std::unique_ptr<show::ShowRenderer> renderer,
      show::ShowRenderer::Create(show->content(), render::QualityLadder().back()));
  LARARIUM_ASSIGN_OR_RETURN(const render::RenderTarget target,
                            render::RenderTarget::Create(kWidth, kHeight));

  player::BeginPlaying();

  const Schedule schedule;
  Judge judge(schedule);
  std::atomic<int> losses = 0;
  const auto open = [&]() -> Result<std::unique_ptr<capture::FrameSource>> {
    if (schedule.Now() == Fault::kUnplugged) {
      return Status::Error("camera 0", "cannot be opened");
    }
    return std::unique_ptr<capture::FrameSource>(
        std::make_unique<FaultyCamera>(recording, schedule));
  };
  const std::unique_ptr<capture::FrameSource> source = capture::MakeSteady(
      std::make_unique<FaultyCamera>(recording, schedule),
      capture::RealWorld(open, [&](bool connected, const std::string&) { losses += connected; }));
  std::atomic<int> sound_openings = 0;
  std::unique_ptr<audio::SoundPlayer> sound;
  if (auto mixer = audio::Mixer::Create(show->sounds(), {}); mixer.ok()) {
    sound = std::make_unique<audio::SoundPlayer>(
        std::move(*mixer),
        [&]() -> Result<std::unique_ptr<audio::AudioOut>> {
          ++sound_openings;
          if (schedule.Now() == Fault::kSoundGone) {
            return Status::Error("sound", "no device");
          }
          LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<audio::AudioOut> none,
                                    audio::CreateAudioOut(audio::AudioOutKind::kNone));
          return std::unique_ptr<audio::AudioOut>(
              std::make_unique<FaultySound>(std::move(none), schedule));
        },
        *log);
  }
  // Its folder cannot be written.
  player::Kiosk kiosk("/proc/lararium", {}, *log);

  const std::span<const render::Quality> ladder = render::QualityLadder();
  show::QualityController quality(
      show::QualityOptions::ForCamera(ladder.size(), recording->frames_per_second()),
      ladder.size() - 1);
  renderer->SetQuality(ladder.back());
  show->SetQuality(ladder.back());
  show::ShowStatistics statistics;
  std::vector<double> memory = {show::ResidentMebibytes()};
  size_t script_errors = 0;
  const Clock::time_point begin = Clock::now();
  const double warm_seconds = std::min(300.0, 0.5 * options.seconds);
  {
    show::RealtimePipeline pipeline({*source, *poses, *show, statistics});
    double elapsed = 0.0;
    while (elapsed < options.seconds) {
      elapsed = std::chrono::duration<double>(Clock::now() - begin).count();
      if (elapsed >= static_cast<double>(memory.size()) * kMemoryInterval) {
        memory.push_back(show::ResidentMebibytes());
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
      if (quality.AddFrame(elapsed, std::max(draw_ms, staged->stage_ms))) {
        renderer->SetQuality(ladder[quality.level()]);
        show->SetQuality(ladder[quality.level()]);
      }
      if (sound != nullptr) {
        sound->Show(staged->sound);
      }
      judge.Frame(*staged);
      kiosk.AfterFrame(elapsed, *staged, *show);
      pipeline.Recycle(std::move(staged));
    }
    pipeline.Stop();
    LARARIUM_RETURN_IF_ERROR(pipeline.status());
  }
  script_errors = show->drama().errors().size();
  judge.ForgetLast();

  bool good = judge.ghosts() == 0;
  Json rows = Json::array();
  std::printf("| fault | injected | recovered | longest, s |\n| --- | --- | --- | --- |\n");
  for (const auto& [fault, outcome] : judge.outcomes()) {
    std::printf("| %s | %d | %d | %.2f |\n", Name(fault), outcome.injected, outcome.recovered,
                outcome.longest);
    rows.push_back({{"fault", Name(fault)},
                    {"injected", outcome.injected},
                    {"recovered", outcome.recovered},
                    {"longest_s", outcome.longest}});
    good = good && outcome.recovered >= outcome.injected;
  }
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
      "%.0f s, %lld frames, camera came back %d times, sound opened %d times, %zu script "
      "errors; memory %.0f MiB after %.0f s, %.0f MiB at the end (%+.1f %%); %d frames with "
      "people where none should be\n",
      options.seconds, static_cast<long long>(statistics.tracking.frames()), losses.load(),
      sound_openings.load(), script_errors, warm_mib, warm_seconds, last_mib, 100.0 * growth,
      judge.ghosts());
  if (!options.out.empty()) {
    LARARIUM_RETURN_IF_ERROR(SaveJson(options.out, {{"faults", rows},
                                                    {"memory_warm_mib", warm_mib},
                                                    {"memory_end_mib", last_mib},
                                                    {"memory_every_10_s_mib", memory},
                                                    {"script_errors", script_errors},
                                                    {"ghosts", judge.ghosts()},
                                                    {"statistics", tracking_json}}));
  }
  if (options.seconds > 2.0 * kScriptErrorSeconds && script_errors == 0) {
    std::printf("the script's errors were not noticed\n");
    good = false;
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
