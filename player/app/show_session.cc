#include "player/app/show_session.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <future>
#include <utility>
#include <vector>

#include "player/app/camera_choice.h"
#include "player/app/heap.h"
#include "shared/capture/looped_source.h"
#include "shared/capture/steady_camera.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/vision/foreground/foreground_mask.h"
#include "shared/vision/pose_smoother.h"
#include "shared/vision/tracker.h"

namespace lararium::player {
namespace {

// The drawing thread checks for input at least this often.
constexpr std::chrono::milliseconds kInputInterval(10);
// Without new pictures the session still counts as alive for kLongestSilence, because the camera
// may be slow. If tracking or staging one image takes longer than kLongestWork, a thread hangs.
constexpr std::chrono::seconds kLongestSilence(8);
constexpr double kLongestWork = 0.2;  // seconds
// If pictures take longer than this, the machine is so slow or busy that a long picture does not
// mean that a thread hangs.
constexpr double kSlowPicture = 250.0;  // milliseconds
// After this number of frames, all shaders of a show have been compiled.
constexpr int64_t kFirstFrames = 90;

volatile std::sig_atomic_t g_end_requested = 0;

// The hour of the day in local time.
float HourNow() {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  return static_cast<float>(local.tm_hour) + static_cast<float>(local.tm_min) / 60.0f +
         static_cast<float>(local.tm_sec) / 3600.0f;
}

double Milliseconds(SteadyClock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

// A player only ever goes back to the beginning, and plays for days: it needs no past.
// In a group, late news change the past.
drama::DramaOptions DramaOptionsOf(const PlayOptions& options, bool in_group) {
  drama::DramaOptions drama;
  drama.seed = options.seed;
  drama.past = options.output.visitor_log.empty() && !in_group ? drama::Past::kForgotten
                                                               : drama::Past::kKept;
  return drama;
}

double SteadySeconds() {
  return std::chrono::duration<double>(SteadyClock::now().time_since_epoch()).count();
}

Result<std::unique_ptr<capture::FrameSource>> OpenSource(const CameraOptions& options,
                                                         const capture::CameraSettings& settings,
                                                         FaultLog& faults) {
  if (options.video.empty() && options.images.empty()) {
    const auto open = [number = options.number.value_or(0), settings] {
      return capture::OpenCamera(number, settings);
    };
    LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<capture::FrameSource> camera, open());
    return capture::MakeSteady(
        std::move(camera),
        capture::RealWorld(
            open,
            [&faults](bool connected, const std::string& why) {
              faults.CameraChanged(connected, why);
            },
            [&faults](bool steady, double leap) { faults.ClockChanged(steady, leap); }));
  }
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<capture::FrameSource> source,
                            options.video.empty() ? capture::OpenImageFolder(options.images)
                                                  : capture::OpenVideo(options.video));
  return options.loop ? capture::Loop(std::move(source)) : std::move(source);
}

}  // namespace

void RequestEnd() { g_end_requested = 1; }

ShowSession::ShowSession(const PlayOptions& options,
                         SteadyClock::time_point started,
                         Log& log,
                         const PlayLinks& links)
    : options_(options),
      started_(started),
      log_(log),
      faults_(log),
      heartbeat_(links.heartbeat),
      restarts_(links.start.number),
      quality_(static_cast<size_t>(options.quality.value_or(0))),
      updates_(links.updates),
      look_for_update_(links.look_for_update),
      maker_(options.bundle, DramaOptionsOf(options, links.in_group), log) {
  GroupPort port;
  if (links.in_group && !lock_step()) {
    feed_.emplace(SteadySeconds);
    port = {[this] { return feed_->TakeOwn(); },
            [this](std::string_view news) { feed_->Take(news); }};
  }
  // Created first, because it collects all warnings of the log.
  if (links.staff.any()) {
    staff_.emplace(links.staff, log, std::move(port));
  }
  controls_.emplace(options.choices, options.kiosk, links.start, log);
}

// --- Preparing

Status ShowSession::Prepare() {
  if (!options_.camera.device.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(device_, LoadDevice(options_.camera.device));
  }
  maker_.SetDevice(device_, options_.camera.look);
  LARARIUM_ASSIGN_OR_RETURN(source_, OpenSource(options_.camera, device_.capture, faults_));
  // In lock-step the level must not depend on the time that anything takes.
  if (!options_.quality && !lock_step()) {
    quality_.Adapt(source_->frames_per_second());
  }
  if (feed_) {
    maker_.SetGroup(feed_->group());
  }
  LARARIUM_ASSIGN_OR_RETURN(const show::ShowContent content, LoadInChosenLanguages());
  LARARIUM_RETURN_IF_ERROR(JoinGroup(content));
  LARARIUM_ASSIGN_OR_RETURN(const CameraChoice camera, ChooseCamera(content));
  LARARIUM_ASSIGN_OR_RETURN(const PictureLayout layout,
                            ChooseLayout(options_.display, device_.headset, camera.camera));
  maker_.SetPicture(layout.size, layout.part, layout.headset && layout.headset->runtime_shows_room);
  if (!options_.visitor.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(drama::VisitorLog visitor, drama::VisitorLog::Load(options_.visitor));
    maker_.SetVisitor(std::move(visitor));
  }
  // Drivers and the drama both need time to start, so they are prepared in parallel.
  std::future<Status> prepared = std::async(std::launch::async, [&]() -> Status {
    LARARIUM_RETURN_IF_ERROR(CreateTracker(content, camera));
    LARARIUM_ASSIGN_OR_RETURN(show_, maker_.Make(content));
    return Status();
  });
  const Status drawing = PrepareDrawing(content, layout);
  const Status playing = prepared.get();
  LARARIUM_RETURN_IF_ERROR(playing);
  LARARIUM_RETURN_IF_ERROR(drawing);
  controls_->Attach(device_.buttons, *poses_, *output_);
  controls_->SetShow(*show_);
  if (const Kiosk* kiosk = controls_->kiosk()) {
    if (const double time = kiosk->ResumeAt(content.title); time > 0.0 && !feed_) {
      show_->input().RestartAt(time);
    }
  }
  ApplyQuality();
  LARARIUM_ASSIGN_OR_RETURN(recorder_,
                            Recorder::Create(options_.output, *source_, output_->shown(), *show_,
                                             options_.listening != Listening::kSpeakers));
  OpenSound();
  if (!options_.osc.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const ListenAddress address,
                              ParseListenAddress("--osc", options_.osc));
    LARARIUM_ASSIGN_OR_RETURN(osc_, OscListener::Open(address, log_));
  }
  return Status();
}

// Dramas are the same where the show, the program and the seed are.
Status ShowSession::JoinGroup(const show::ShowContent& content) {
  if (!feed_) {
    controls_->SetMarkers(group::MarkersOf(content.drama));
    return Status();
  }
  if (!options_.visitor.empty() || !options_.output.visitor_log.empty()) {
    return Status::Error("--visitor, --visitor-log", "cannot go with a group",
                         "play alone with --fleet and without --group");
  }
  feed_->SetShow(
      maker_.drama_version() + " " + LARARIUM_VERSION + " " + std::to_string(options_.seed),
      group::MarkersOf(content.drama));
  return Status();
}

// The choices of a kiosk's last visitor may belong to another show, so loading may fail with them.
Result<show::ShowContent> ShowSession::LoadInChosenLanguages() {
  Result<show::ShowContent> loaded = maker_.Load(controls_->languages(), FinestDetail());
  if (!loaded.ok() && controls_->kiosk() != nullptr) {
    controls_->ResetLanguages();
    loaded = maker_.Load(controls_->languages(), FinestDetail());
  }
  return loaded;
}

// In lock-step nothing may depend on the time at which a finer level of detail is loaded.
float ShowSession::FinestDetail() const {
  if (lock_step()) {
    return 0.0f;
  }
  const std::optional<PictureSize>& size = options_.display.size;
  return show::FinestDetail(quality_.quality(), size ? size->width : source_->width());
}

Result<CameraChoice> ShowSession::ChooseCamera(const show::ShowContent& content) const {
  std::vector<TrainedCamera> trained;
  for (const show::ShowPlace& place : content.places) {
    trained.push_back({place.stage.name, place.map->camera});
  }
  LARARIUM_ASSIGN_OR_RETURN(
      const CameraChoice choice,
      player::ChooseCamera(options_.camera, trained, source_->width(), source_->height()));
  log_.Info("camera intrinsics from {}", choice.origin);
  return choice;
}

Status ShowSession::CreateTracker(const show::ShowContent& content, const CameraChoice& camera) {
  vision::TrackerOptions tracking;
  tracking.known_camera = camera.known;
  tracking.seed = options_.seed;
  tracking.threads = options_.threads;
  tracking.background =
      lock_step() ? vision::BackgroundWork::kJoined : vision::BackgroundWork::kFree;
  LARARIUM_ASSIGN_OR_RETURN(
      poses_, vision::CreateTracker(show::Maps(content.places), camera.camera, tracking));
  show::SetOccluders(content.places, *poses_);
  if (options_.foreground) {
    poses_ = vision::WithForeground(std::move(poses_), show::Maps(content.places));
  }
  poses_ = vision::Smooth(std::move(poses_), show::Maps(content.places), options_.smoothing);
  return Status();
}

Status ShowSession::PrepareDrawing(const show::ShowContent& content, const PictureLayout& layout) {
  LARARIUM_ASSIGN_OR_RETURN(
      output_, PictureOutput::Open(options_.display, layout, content, quality_.quality(),
                                   options_.bundle.show.string(), log_));
  if (staff_) {
    staff_->Prepare(output_->picture());
  }
  output_->renderer().SetEvidence(options_.evidence);
  for (const show::ShowPlace& place : content.places) {
    statistics_.places.push_back(place.stage.name);
  }
  statistics_.gpu = render::GraphicsDeviceName();
  statistics_.graphics = render::Name(render::CurrentGraphicsApi());
  log_.Info("drawn with {} by {}", statistics_.graphics, statistics_.gpu);
  return Status();
}

// Failing to open sound is not an error: the show is played without it.
void ShowSession::OpenSound() {
  const Listening listening = options_.listening.value_or(
      options_.display.headless ? Listening::kNone : Listening::kHeadphones);
  if (lock_step() || listening == Listening::kNone || show_->sounds()->clips().empty()) {
    return;
  }
  audio::MixerOptions mixing;
  mixing.hrtf = listening == Listening::kHeadphones;
  Result<std::unique_ptr<audio::Mixer>> mixer = audio::Mixer::Create(show_->sounds(), mixing);
  if (!mixer.ok()) {
    log_.Warn("{}; the show goes on in silence", mixer.message());
    return;
  }
  sound_ = std::make_unique<audio::SoundPlayer>(
      std::move(*mixer), [] { return audio::CreateAudioOut(audio::AudioOutKind::kDevice); }, log_);
  SetVolume();
}

// --- The loop

bool ShowSession::Outdated() {
  return updates_ != nullptr && updates_->ready() && controls_->kiosk() != nullptr &&
         !controls_->kiosk()->visited();
}

bool ShowSession::KeepGoing(double longest_work) {
  const bool enough = options_.frames > 0 && drawn_frames_ >= options_.frames;
  const bool keep_going = g_end_requested == 0 && !controls_->ends() && !enough && !Outdated() &&
                          output_->screen().KeepGoing();
  TakeInput();
  if (drawn_frames_ > 0 && SteadyClock::now() - last_shown_ < kLongestSilence &&
      longest_work < kLongestWork) {
    heartbeat_.Beat();
  }
  if (!lock_step()) {
    show_->input().SetHour(HourNow());
  }
  return keep_going;
}

void ShowSession::TakeInput() {
  for (const std::string& message : osc_ != nullptr ? osc_->Take() : std::vector<std::string>()) {
    show_->input().PressKey(message);
  }
  for (const std::string& key : output_->screen().TakeKeys()) {
    controls_->PressKey(key, Now());
  }
  if (staff_) {
    for (const StaffCommand& command : staff_->link().TakeCommands()) {
      controls_->Obey(command, Now());
      if (command.update && look_for_update_) {
        look_for_update_();
      } else if (command.update) {
        log_.Warn("no updates are looked for: the player was started without --updates");
      }
    }
  }
  SetVolume();
}

void ShowSession::SetVolume() {
  if (sound_ != nullptr) {
    sound_->SetVolume(controls_->volume());
  }
}

void ShowSession::ApplyQuality() {
  heartbeat_.BeatBeforeLongWork();  // Drivers may have to compile shaders.
  output_->renderer().SetQuality(quality_.quality());
  show_->detail().SetQuality(quality_.quality());
}

void ShowSession::AddTimes(const show::StagedFrame& staged, SteadyClock::time_point drawn) {
  const SteadyClock::time_point now = SteadyClock::now();
  statistics_.located_age.Add(Milliseconds(staged.times.located - staged.times.arrival));
  statistics_.staged_age.Add(Milliseconds(staged.times.staged - staged.times.arrival));
  statistics_.drawn_age.Add(Milliseconds(drawn - staged.times.arrival));
  statistics_.shown_age.Add(Milliseconds(now - staged.times.arrival));
  statistics_.total.Add(Milliseconds(now - staged.times.arrival));
  if (drawn_frames_ == 0) {
    statistics_.startup_seconds = Seconds(now);
  } else {
    statistics_.interval.Add(Milliseconds(now - last_shown_));
  }
  last_shown_ = now;
  ++drawn_frames_;
}

// Called also between two images of the camera.
Status ShowSession::ServeOpenXr() {
  if (OpenXrHeadset* headset = output_->openxr()) {
    LARARIUM_ASSIGN_OR_RETURN(const bool more, headset->Frame());
    if (!more) {
      log_.Info("the headset's runtime ended the session");
      RequestEnd();
    }
    for (const std::string& button : headset->TakeButtons()) {
      controls_->PressKey(button, Now());
    }
  }
  return Status();
}

Status ShowSession::DrawFrame(show::StagedFrame& staged) {
  drama_time_ = staged.time;
  if (options_.staff) {
    ShowTracking();
  }
  controls_->BeforeFrame(staged, Now());
  if (draw_ms_ > kSlowPicture) {
    heartbeat_.BeatBeforeLongWork();
  }
  const SteadyClock::time_point begin = SteadyClock::now();
  SteadyClock::time_point drawn;
  {
    const ScopedStageTimer timer(statistics_.render);
    LARARIUM_RETURN_IF_ERROR(
        output_->Draw(staged, Now(), controls_->shown(),
                      [this](const geometry::CameraModel& eye) { controls_->ShowMenu(eye); }));
    drawn = SteadyClock::now();
    output_->Present();
  }
  if (updates_ != nullptr) {
    updates_->Shown();
  }
  if (sound_ != nullptr) {
    sound_->Show(staged.sound);
  }
  AddTimes(staged, drawn);
  faults_.AfterFrame(staged.tracked);
  draw_ms_ = Milliseconds(drawn - begin);
  const std::optional<double> work_ms =
      staged.camera.camera_from_stage ? std::optional(std::max(draw_ms_, staged.times.stage_ms))
                                      : std::nullopt;
  if (quality_.AfterFrame(Seconds(last_shown_), work_ms, log_)) {
    ApplyQuality();
  }
  heartbeat_.Beat();
  controls_->AfterFrame(staged, Seconds(last_shown_));
  if (feed_) {
    const Kiosk* kiosk = controls_->kiosk();
    feed_->SetVisited(kiosk != nullptr ? kiosk->visited()
                                       : staged.tracked.camera_from_map.has_value());
  }
  SetVolume();
  TellStaff(staged);
  if (drawn_frames_ == kFirstFrames) {
    render::ReleaseShaderCompiler();
    heap_keeper_.emplace(kKeepInterval);
  }
  return recorder_->Add(staged, output_->shown());
}

void ShowSession::TellStaff(const show::StagedFrame& staged) {
  if (!staff_) {
    return;
  }
  staff_->AfterFrame(staged, output_->picture(), [&](StaffState& state) {
    controls_->FillStaffState(staged, state);
    state.show = maker_.version();
    state.quality = quality_.level();
    state.audible = sound_ != nullptr;
    state.up_seconds = Seconds(last_shown_);
    state.restarts = restarts_;
  });
  const Kiosk* kiosk = controls_->kiosk();
  if (kiosk != nullptr && told_statistics_ != kiosk->statistics_version()) {
    told_statistics_ = kiosk->statistics_version();
    staff_->link().TellStatistics(kiosk->statistics());
  }
}

// Adds quality and frame rate to the state of tracking that is drawn for the staff.
void ShowSession::ShowTracking() {
  char more[64];
  const double rate =
      statistics_.interval.count() == 0 ? 0.0 : 1000.0 / statistics_.interval.mean();
  std::snprintf(more, sizeof(more), "   quality %zu   %.0f/s", quality_.level(), rate);
  output_->renderer().SetStaff(more);
}

// Another language needs other texts and voices. The show continues while they are loaded. In
// lock-step a frame must not depend on the time that loading takes, so it is waited for.
bool ShowSession::OtherLanguagesAreReady() {
  maker_.BeginOther(controls_->languages(), drama_time_, FinestDetail());
  return maker_.OtherIsReady(lock_step());
}

// The drama continues at the same time. Call this while no frame is being staged or drawn.
Status ShowSession::ChangeLanguages() {
  heartbeat_.BeatBeforeLongWork();
  Result<std::unique_ptr<show::Show>> next = maker_.TakeOther();
  const show::LanguageChoice& languages = maker_.languages();
  if (!next.ok()) {
    log_.Warn("{}; the languages stay", next.message());
    controls_->KeepLanguages(languages, Now());
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR((*next)->ResumeFrom(*show_));
  LARARIUM_RETURN_IF_ERROR(recorder_->SetShow(**next));
  sound_.reset();
  show_ = std::move(*next);
  controls_->SetShow(*show_);
  show_->detail().SetQuality(quality_.quality());
  OpenSound();
  log_.Info("language '{}', captions '{}'", languages.spoken, languages.captions);
  return output_->renderer().SetTexts(show_->content());
}

Status ShowSession::RunLockStep() {
  std::optional<show::LockStep> lock_step(std::in_place, stages());
  show::StagedFrame staged;
  while (KeepGoing()) {
    if (OtherLanguagesAreReady()) {
      lock_step.reset();
      LARARIUM_RETURN_IF_ERROR(ChangeLanguages());
      lock_step.emplace(stages());
    }
    LARARIUM_ASSIGN_OR_RETURN(const bool more, lock_step->Next(staged));
    if (!more) {
      break;
    }
    LARARIUM_RETURN_IF_ERROR(DrawFrame(staged));
    LARARIUM_RETURN_IF_ERROR(ServeOpenXr());
  }
  return Status();
}

Status ShowSession::RunRealtime() {
  std::optional<show::RealtimePipeline> pipeline(std::in_place, stages());
  while (!pipeline->Finished() && KeepGoing(pipeline->LongestWork())) {
    if (OtherLanguagesAreReady()) {
      pipeline.reset();
      LARARIUM_RETURN_IF_ERROR(ChangeLanguages());
      pipeline.emplace(stages());
    }
    LARARIUM_RETURN_IF_ERROR(ServeOpenXr());
    // With a headset, ServeOpenXr has waited for the display already.
    const auto wait = output_->openxr() != nullptr ? std::chrono::milliseconds(0) : kInputInterval;
    if (std::unique_ptr<show::StagedFrame> staged = pipeline->Take(wait)) {
      LARARIUM_RETURN_IF_ERROR(DrawFrame(*staged));
      pipeline->Recycle(std::move(staged));
    }
  }
  pipeline->Stop();
  return pipeline->status();
}

void ShowSession::TellNotes(size_t first) {
  const std::vector<std::string> notes = source_->Notes();
  for (size_t i = first; i < notes.size(); ++i) {
    log_.Warn("{}", notes[i]);
  }
}

Result<PlayEnd> ShowSession::Run() {
  TellNotes(0);
  const size_t told = source_->Notes().size();
  const Status played = lock_step() ? RunLockStep() : RunRealtime();
  TellNotes(told);
  LARARIUM_RETURN_IF_ERROR(played);
  if (OpenXrHeadset* headset = output_->openxr()) {
    LARARIUM_RETURN_IF_ERROR(headset->End());
  }
  LARARIUM_RETURN_IF_ERROR(recorder_->Finish());
  statistics_.quality = quality_.ToJson();
  if (!options_.output.stats.empty()) {
    LARARIUM_RETURN_IF_ERROR(SaveJson(options_.output.stats, statistics_.ToJson()));
  }
  if (!options_.output.visitor_log.empty()) {
    LARARIUM_RETURN_IF_ERROR(
        WriteFileAtomically(options_.output.visitor_log, show_->drama().visitor_log().Write()));
  }
  log_.Info("{} frames shown, {:.1f} % tracked", drawn_frames_,
            100.0 * statistics_.tracking.tracked_fraction());
  if (g_end_requested == 0 && (controls_->restarts() || Outdated())) {
    log_.Info("{}", controls_->restarts() ? "the staff asked to restart the player"
                                          : "a newer show is there; it is started");
    return PlayEnd::kStartAgain;
  }
  return PlayEnd::kOver;
}

}  // namespace lararium::player
