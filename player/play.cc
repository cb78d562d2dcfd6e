#include "player/play.h"

#include <csignal>
#include <ctime>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "player/camera_choice.h"
#include "player/device_file.h"
#include "player/osc.h"
#include "player/recorder.h"
#include "player/screen.h"
#include "shared/audio/sound_player.h"
#include "shared/bundle/bundle.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/parallel.h"
#include "shared/show/frame_pipeline.h"
#include "shared/show/show_renderer.h"
#include "shared/vision/pose_smoother.h"
#include "shared/vision/tracker.h"

namespace lararium::player {
namespace {

using SteadyClock = std::chrono::steady_clock;

// The drawing thread looks for input at least this often.
constexpr std::chrono::milliseconds kInputInterval(10);

// Not the drama's: switches the evidence view.
constexpr std::string_view kEvidenceKey = "f2";

volatile std::sig_atomic_t g_end_requested = 0;

void RequestEnd(int /*signal*/) { g_end_requested = 1; }

// Of the day, where the player stands.
float HourNow() {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  return static_cast<float>(local.tm_hour) + static_cast<float>(local.tm_min) / 60.0f +
         static_cast<float>(local.tm_sec) / 3600.0f;
}

Result<std::unique_ptr<capture::FrameSource>> OpenSource(const PlayOptions& options) {
  if (!options.video.empty()) {
    return capture::OpenVideo(options.video);
  }
  if (!options.images.empty()) {
    return capture::OpenImageFolder(options.images);
  }
  return capture::OpenCamera(options.camera.value_or(0));
}

Result<show::ShowContent> LoadContent(const PlayOptions& options) {
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(options.show));
  return show::LoadShowContent(bundle, options.place, {options.language, options.captions});
}

// Where the device says nothing of its camera, each place keeps what the bundle says.
Status SetLook(const PlayOptions& options, show::ShowContent& content) {
  Device device;
  if (!options.device.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(device, LoadDevice(options.device));
  }
  for (show::ShowPlace& place : content.places) {
    if (!options.camera_look) {
      place.stage.camera.reset();
    } else if (device.look) {
      place.stage.camera = device.look;
    }
  }
  return Status();
}

std::vector<TrainedCamera> TrainedCameras(const show::ShowContent& content) {
  std::vector<TrainedCamera> cameras;
  for (const show::ShowPlace& place : content.places) {
    cameras.push_back({place.stage.name, place.map->camera});
  }
  return cameras;
}

// One run of a show: all that lives from its first frame to its last.
class Performance {
 public:
  Performance(const PlayOptions& options, SteadyClock::time_point started, Log& log)
      : options_(options), started_(started), log_(log) {}

  Status Prepare();
  Status Run();

 private:
  show::FrameStages stages() { return {*source_, *poses_, *show_, statistics_}; }
  bool KeepGoing() {
    const bool enough = options_.frames > 0 && drawn_frames_ >= options_.frames;
    const bool keep_going = g_end_requested == 0 && !enough && screen_->KeepGoing();
    for (const std::string& key : screen_->TakeKeys()) {
      if (key == kEvidenceKey) {
        renderer_->SetEvidence(!renderer_->shows_evidence());
      } else {
        show_->PressKey(key);
      }
    }
    for (const std::string& message : osc_ != nullptr ? osc_->Take() : std::vector<std::string>()) {
      show_->PressKey(message);
    }
    if (options_.pace == Pace::kRealtime) {
      show_->SetHour(HourNow());
    }
    return keep_going;
  }
  void OpenSound();
  Status RunLockStep();
  Status RunRealtime();
  Status DrawFrame(const show::StagedFrame& staged);

  const PlayOptions& options_;
  SteadyClock::time_point started_;
  Log& log_;
  std::unique_ptr<capture::FrameSource> source_;
  std::unique_ptr<vision::PoseSource> poses_;
  std::unique_ptr<show::Show> show_;
  std::optional<Screen> screen_;  // before all that draws: destroyed after it
  std::unique_ptr<show::ShowRenderer> renderer_;
  std::optional<render::RenderTarget> target_;
  std::optional<Recorder> recorder_;
  std::unique_ptr<audio::SoundPlayer> sound_;  // nullptr: nothing is heard
  std::unique_ptr<OscListener> osc_;           // nullptr: nobody listens
  show::ShowStatistics statistics_;
  int64_t drawn_frames_ = 0;
};

Status Performance::Prepare() {
  LARARIUM_ASSIGN_OR_RETURN(source_, OpenSource(options_));
  LARARIUM_ASSIGN_OR_RETURN(show::ShowContent content, LoadContent(options_));
  LARARIUM_ASSIGN_OR_RETURN(
      const CameraChoice choice,
      ChooseCamera(options_, TrainedCameras(content), source_->width(), source_->height()));
  log_.info("camera intrinsics from {}", choice.origin);
  LARARIUM_RETURN_IF_ERROR(SetLook(options_, content));
  for (const show::ShowPlace& place : content.places) {
    statistics_.places.push_back(place.stage.name);
  }
  vision::TrackerOptions tracking;
  tracking.seed = options_.seed;
  tracking.threads = options_.threads;
  tracking.background = options_.pace == Pace::kFast ? vision::BackgroundWork::kJoined
                                                     : vision::BackgroundWork::kFree;
  LARARIUM_ASSIGN_OR_RETURN(
      poses_, vision::CreateTracker(show::Maps(content.places), choice.camera, tracking));
  show::SetOccluders(content.places, *poses_);
  poses_ = vision::Smooth(std::move(poses_), show::Maps(content.places), options_.smoothing);
  drama::DramaOptions drama;
  drama.seed = options_.seed;
  LARARIUM_ASSIGN_OR_RETURN(show_, show::Show::Create(std::move(content), drama, log_));

  if (!options_.visitor.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(drama::VisitorLog visitor, drama::VisitorLog::Load(options_.visitor));
    show_->drama().SetVisitorLog(std::move(visitor));
  }

  LARARIUM_ASSIGN_OR_RETURN(screen_, Screen::Open(options_, show_->content().title));
  LARARIUM_ASSIGN_OR_RETURN(renderer_, show::ShowRenderer::Create(show_->content()));
  renderer_->SetEvidence(options_.evidence);
  // Videos have even sides.
  LARARIUM_ASSIGN_OR_RETURN(
      target_, render::RenderTarget::Create(source_->width() & ~1, source_->height() & ~1));
  LARARIUM_ASSIGN_OR_RETURN(recorder_, Recorder::Create(options_, *source_, *target_, *show_));
  OpenSound();
  if (!options_.osc.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const OscAddress address, ParseOscAddress(options_.osc));
    LARARIUM_ASSIGN_OR_RETURN(osc_, OscListener::Open(address, log_));
  }
  statistics_.gpu = render::GraphicsDeviceName();
  return Status();
}

// A show without sound is better than none.
void Performance::OpenSound() {
  const Listening listening =
      options_.listening.value_or(options_.headless ? Listening::kNone : Listening::kHeadphones);
  if (options_.pace == Pace::kFast || listening == Listening::kNone ||
      show_->sounds()->clips().empty()) {
    return;
  }
  audio::MixerOptions mixing;
  mixing.hrtf = listening == Listening::kHeadphones;
  Result<std::unique_ptr<audio::Mixer>> mixer = audio::Mixer::Create(show_->sounds(), mixing);
  if (!mixer.ok()) {
    log_.warn("{}; the show goes on in silence", mixer.message());
    return;
  }
  sound_ = std::make_unique<audio::SoundPlayer>(
      std::move(*mixer), [] { return audio::CreateAudioOut(audio::AudioOutKind::kDevice); }, log_);
}

Status Performance::DrawFrame(const show::StagedFrame& staged) {
  {
    const ScopedStageTimer timer(statistics_.render);
    LARARIUM_RETURN_IF_ERROR(renderer_->Draw(staged, *target_));
    screen_->Present(*target_);
  }
  if (sound_ != nullptr) {
    sound_->Show(staged.sound);
  }
  const SteadyClock::time_point now = SteadyClock::now();
  if (drawn_frames_ == 0) {
    statistics_.startup_seconds = std::chrono::duration<double>(now - started_).count();
  }
  const std::chrono::duration<double, std::milli> total = now - staged.arrival;
  statistics_.total.Add(total.count());
  ++drawn_frames_;
  return recorder_->Add(staged, *target_);
}

Status Performance::RunLockStep() {
  show::LockStep lock_step(stages());
  show::StagedFrame staged;
  while (KeepGoing()) {
    LARARIUM_ASSIGN_OR_RETURN(const bool more, lock_step.Next(staged));
    if (!more) {
      break;
    }
    LARARIUM_RETURN_IF_ERROR(DrawFrame(staged));
  }
  return Status();
}

Status Performance::RunRealtime() {
  show::RealtimePipeline pipeline(stages());
  while (!pipeline.Finished() && KeepGoing()) {
    if (std::unique_ptr<show::StagedFrame> staged = pipeline.Take(kInputInterval)) {
      LARARIUM_RETURN_IF_ERROR(DrawFrame(*staged));
      pipeline.Recycle(std::move(staged));
    }
  }
  pipeline.Stop();
  return pipeline.status();
}

Status Performance::Run() {
  LARARIUM_RETURN_IF_ERROR(options_.pace == Pace::kFast ? RunLockStep() : RunRealtime());
  LARARIUM_RETURN_IF_ERROR(recorder_->Finish());
  if (!options_.stats_out.empty()) {
    LARARIUM_RETURN_IF_ERROR(SaveJson(options_.stats_out, statistics_.ToJson()));
  }
  if (!options_.visitor_log.empty()) {
    LARARIUM_RETURN_IF_ERROR(
        WriteFileAtomically(options_.visitor_log, show_->drama().visitor_log().Write()));
  }
  log_.info("{} frames shown, {:.1f} % tracked", drawn_frames_,
            100.0 * statistics_.tracking.tracked_fraction());
  return Status();
}

}  // namespace

Status Play(const PlayOptions& options, SteadyClock::time_point started, Log& log) {
  std::signal(SIGINT, RequestEnd);
  std::signal(SIGTERM, RequestEnd);
  std::optional<ThreadLimit> limit;
  if (options.threads > 0) {
    limit.emplace(options.threads);
  }
  Performance performance(options, started, log);
  LARARIUM_RETURN_IF_ERROR(performance.Prepare());
  return performance.Run();
}

}  // namespace lararium::player
