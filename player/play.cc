#include "player/play.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <future>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "player/camera_choice.h"
#include "player/device_file.h"
#include "player/fault_log.h"
#include "player/heap.h"
#include "player/kiosk.h"
#include "player/openxr_display.h"
#include "player/osc.h"
#include "player/power_sensors.h"
#include "player/recorder.h"
#include "player/sandbox.h"
#include "player/screen.h"
#include "player/show_maker.h"
#include "player/staff_reporter.h"
#include "player/stereo_display.h"
#include "player/visitor_menu.h"
#include "shared/audio/sound_player.h"
#include "shared/capture/looped_source.h"
#include "shared/capture/steady_camera.h"
#include "shared/core/file.h"
#include "shared/core/json.h"
#include "shared/core/parallel.h"
#include "shared/render/quality.h"
#include "shared/show/frame_pipeline.h"
#include "shared/show/show_renderer.h"
#include "shared/vision/pose_smoother.h"
#include "shared/vision/tracker.h"

namespace lararium::player {
namespace {

using SteadyClock = std::chrono::steady_clock;

// The drawing thread looks for input at least this often.
constexpr std::chrono::milliseconds kInputInterval(10);
constexpr double kPowerSeconds = 5.0;
// Without pictures it is still alive: the camera may take its time. Not while one image is
// tracked, or staged, for longer than this: then a thread hangs.
constexpr std::chrono::seconds kLongestSilence(8);
constexpr double kLongestWork = 0.2;  // seconds
// Pictures that take longer are those of a machine so slow, or so busy, that a long one is no
// sign of a hang.
constexpr double kSlowPicture = 250.0;  // milliseconds
// After these all that a show needs has been compiled.
constexpr int64_t kFirstFrames = 90;

// Not the drama's: switches the evidence view.
constexpr std::string_view kEvidenceKey = "f2";
// The drama's too; leaves the player, unless it is a kiosk.
constexpr std::string_view kLeaveKey = "escape";

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

const render::Quality& QualityOf(size_t level) {
  const std::span<const render::Quality> ladder = render::QualityLadder();
  return ladder[std::min(level, ladder.size() - 1)];
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
  Performance(const PlayOptions& options,
              SteadyClock::time_point started,
              Log& log,
              const ChildStart& start,
              Heartbeat heartbeat,
              int staff_link)
      : options_(options),
        started_(started),
        log_(log),
        faults_(log),
        heartbeat_(heartbeat),
        restarts_(start.number),
        maker_(options, log) {
    // First: it hears of all that the log is told.
    if (staff_link >= 0) {
      staff_.emplace(staff_link, log);
    }
    if (options.kiosk) {
      kiosk_.emplace(options.state.empty() ? DefaultStateFolder() : options.state, start, log);
      kiosk_->SetVisit({.longest = 60.0 * options.visit_minutes});
      choices_ = kiosk_->state().choices;
      house_ = kiosk_->state().house;
    }
    ApplyOptions(house_);
    ApplyOptions(choices_);
  }

  Status Prepare();
  Status Run();

 private:
  show::FrameStages stages() { return {*source_, *poses_, *show_, statistics_}; }
  double Seconds(SteadyClock::time_point time) const {
    return std::chrono::duration<double>(time - started_).count();
  }
  // longest_work: as RealtimePipeline has it.
  bool KeepGoing(double longest_work = 0.0);
  void PressKeys();
  void PressKey(const std::string& key);
  void Do(Action action);
  void Change(const Choices& choices);
  void ObeyStaff();
  Offer offer() const {
    const show::ShowContent& content = show_->content();
    return {content.spoken_languages, content.caption_languages, content.has_descriptions};
  }
  void Obey(const StaffCommand& command);
  void TellStaff(const show::StagedFrame& staged);
  void FillStaffState(const show::StagedFrame& staged, StaffState& state) const;
  size_t level() const;
  void ToggleMenu();
  void ShowMenu(const show::StagedFrame& staged);
  Status OpenSource();
  void ApplyOptions(Choices& choices) const;
  show::LanguageChoice languages() const { return {choices_.language, choices_.captions}; }
  Result<show::ShowContent> LoadInChosenLanguages();
  Status ChooseHeadset();
  // As show::LoadShowContent takes it.
  float FinestDetail() const;
  Status ChooseView(const show::ShowContent& content);
  Status CreateTracker(const show::ShowContent& content);
  void TellKiosk();
  void TellShow();
  // How much is heard and seen of a visit that may be over.
  float Shown() const { return kiosk_ ? kiosk_->shown() : 1.0f; }
  void SetVolume();
  Status PrepareDrawing(const show::ShowContent& content);
  void BeginChangingLanguages();
  bool OtherLanguagesAreReady();
  Status ChangeLanguages();
  void ChooseFirstLevel();
  void OpenSound();
  Status RunLockStep();
  Status RunRealtime();
  Status DrawPicture(const show::StagedFrame& staged);
  void ShowMenuTo(const geometry::CameraModel& picture);
  Status ServeOpenXr();
  const render::RenderTarget& shown() const { return stereo_ ? stereo_->panel() : *target_; }
  Status DrawFrame(show::StagedFrame& staged);
  void AfterFrame(const show::StagedFrame& staged);
  void AddTimes(const show::StagedFrame& staged, SteadyClock::time_point drawn);
  void ChooseQuality(SteadyClock::time_point now, double work_ms);
  void SetLevel(size_t level);
  void ShowToStaff();

  const PlayOptions& options_;
  SteadyClock::time_point started_;
  Log& log_;
  FaultLog faults_;
  Heartbeat heartbeat_;
  std::optional<Kiosk> kiosk_;
  int restarts_;               // before this run
  bool begin_again_ = false;   // the watchdog is to begin it again
  double story_length_ = 0.0;  // seconds; 0: not known
  int64_t told_statistics_ = -1;
  Choices choices_;
  Choices house_;                         // of staff: how a kiosk's next visitor finds it
  show::LanguageChoice shown_languages_;  // of show_, as they were chosen
  GazeMenu menu_;
  double drama_time_ = 0.0;  // of the frame drawn last
  Device device_;
  std::optional<Headset> headset_;  // that is shown on
  geometry::CameraModel camera_;
  show::ViewPart part_;  // of the camera's view, that is drawn
  PictureSize size_;
  std::unique_ptr<capture::FrameSource> source_;
  std::unique_ptr<vision::PoseSource> poses_;
  ShowMaker maker_;
  std::unique_ptr<show::Show> show_;
  std::optional<Screen> screen_;  // before all that draws: destroyed after it
  std::unique_ptr<show::ShowRenderer> renderer_;
  std::optional<render::RenderTarget> target_;
  std::optional<StereoDisplay> stereo_;
  std::unique_ptr<OpenXrDisplay> openxr_;  // nullptr: there is no such headset
  std::optional<StaffReporter> staff_;     // none: there is no page for staff
  std::optional<Recorder> recorder_;
  std::unique_ptr<audio::SoundPlayer> sound_;  // nullptr: nothing is heard
  std::unique_ptr<OscListener> osc_;           // nullptr: nobody listens
  std::optional<show::QualityController> quality_;
  std::optional<PowerWatch> power_;  // where the quality is not fixed
  show::ShowStatistics statistics_;
  SteadyClock::time_point last_shown_;
  double draw_ms_ = 0.0;  // of the last picture
  int64_t drawn_frames_ = 0;
  // A show in other languages, and which, while it is made. Last: it makes use of what is above.
  show::LanguageChoice next_languages_;
  std::future<Result<std::unique_ptr<show::Show>>> next_show_;
};

bool Performance::KeepGoing(double longest_work) {
  const bool enough = options_.frames > 0 && drawn_frames_ >= options_.frames;
  const bool keep_going = g_end_requested == 0 && !enough && screen_->KeepGoing();
  PressKeys();
  ObeyStaff();
  if (drawn_frames_ > 0 && SteadyClock::now() - last_shown_ < kLongestSilence &&
      longest_work < kLongestWork) {
    heartbeat_.Beat();
  }
  if (options_.pace == Pace::kRealtime) {
    show_->SetHour(HourNow());
  }
  return keep_going;
}

void Performance::PressKeys() {
  for (const std::string& message : osc_ != nullptr ? osc_->Take() : std::vector<std::string>()) {
    show_->PressKey(message);
  }
  for (const std::string& key : screen_->TakeKeys()) {
    if (key == kEvidenceKey) {
      renderer_->SetEvidence(!renderer_->shows_evidence());
      continue;
    }
    PressKey(key);
  }
}

// What the menu does not take is the drama's too.
void Performance::PressKey(const std::string& key) {
  const double now = Seconds(SteadyClock::now());
  if (kiosk_) {
    kiosk_->Touch(now, *show_);
  }
  const GazeMenu::Pressed pressed = menu_.Press(key, now);
  if (pressed.action) {
    Do(*pressed.action);
  }
  if (pressed.taken) {
    return;
  }
  show_->PressKey(key);
  if (const std::optional<Action> action = device_.buttons.ActionOf(key)) {
    Do(*action);
  }
  if (key == kLeaveKey && !kiosk_) {
    g_end_requested = 1;
  }
}

void Performance::Do(Action action) {
  switch (action) {
    case Action::kRestart:
      if (kiosk_) {
        kiosk_->BeginAgain(Seconds(SteadyClock::now()), *show_);
      } else {
        show_->RestartAt(0.0);
      }
      break;
    case Action::kFindAnew:
      poses_->FindAnew();
      show_->ForgetPose();
      break;
    case Action::kMenu:
      ToggleMenu();
      break;
    default: {
      Choices choices = choices_;
      Choose(action, offer(), choices);
      Change(choices);
    }
  }
}

// Lets what is chosen be heard and read.
void Performance::Change(const Choices& choices) {
  if (choices == choices_) {
    return;
  }
  choices_ = choices;
  SetVolume();
  renderer_->SetCaptionStyle(choices_.caption_style);
  TellShow();
  menu_.SetItems(ItemsOf(show_->content(), choices_));
  if (kiosk_) {
    kiosk_->Keep(choices_, house_, Seconds(SteadyClock::now()));
  }
}

void Performance::SetVolume() {
  if (sound_ != nullptr) {
    sound_->SetVolume(static_cast<float>(choices_.volume) * Shown());
  }
}

void Performance::ObeyStaff() {
  if (staff_) {
    for (const StaffCommand& command : staff_->link().TakeCommands()) {
      Obey(command);
    }
  }
}

// For whoever watches, and for those who come after.
void Performance::Obey(const StaffCommand& command) {
  Choose(command, offer(), house_);
  if (command.action) {
    Choose(*command.action, offer(), house_);
  }
  if (kiosk_) {
    kiosk_->Keep(choices_, house_, Seconds(SteadyClock::now()));
  }
  Choices choices = choices_;
  Choose(command, offer(), choices);
  Change(choices);
  if (command.action) {
    Do(*command.action);
  }
  begin_again_ = begin_again_ || (command.begin_again && kiosk_);
  if (command.end || begin_again_) {
    g_end_requested = 1;
  }
}

void Performance::TellStaff(const show::StagedFrame& staged) {
  if (!staff_) {
    return;
  }
  staff_->AfterFrame(staged, *target_,
                     [this, &staged](StaffState& state) { FillStaffState(staged, state); });
  if (kiosk_ && told_statistics_ != kiosk_->statistics_version()) {
    told_statistics_ = kiosk_->statistics_version();
    staff_->link().TellStatistics(kiosk_->statistics());
  }
}

void Performance::FillStaffState(const show::StagedFrame& staged, StaffState& state) const {
  const show::ShowContent& content = show_->content();
  state.title = content.title;
  state.place = content.places[staged.place].stage.name;
  state.length = story_length_ > 0.0 ? std::optional(story_length_) : std::nullopt;
  state.kiosk = kiosk_.has_value();
  state.visitor = kiosk_ ? std::optional(kiosk_->visited()) : std::nullopt;
  state.quality = level();
  state.choices = choices_;
  state.audible = sound_ != nullptr;
  state.languages = content.spoken_languages;
  state.caption_languages = content.caption_languages;
  state.has_descriptions = content.has_descriptions;
  state.up_seconds = Seconds(last_shown_);
  state.restarts = restarts_;
}

size_t Performance::level() const {
  return quality_ ? quality_->level() : static_cast<size_t>(options_.quality.value_or(0));
}

void Performance::ToggleMenu() {
  std::vector<MenuItem> items = ItemsOf(show_->content(), choices_);
  if (menu_.open() || items.empty()) {
    menu_.Close();
    return;
  }
  const double scale =
      ScaleFor(renderer_->PictureOf(camera_, size_.width, size_.height), items.size());
  menu_.Open(std::move(items), Seconds(SteadyClock::now()), scale);
}

// Where the menu is in the frame, and what is chosen by looking at it.
void Performance::ShowMenu(const show::StagedFrame& staged) {
  const bool tracked = staged.tracked.camera_from_map.has_value();
  if (const std::optional<Action> action = menu_.Look(
          Seconds(SteadyClock::now()), tracked ? staged.camera_from_stage : std::nullopt)) {
    Do(*action);
  }
  ShowMenuTo(renderer_->PictureOf(staged.tracked.camera, size_.width, size_.height)
                 .Resized(size_.width, size_.height));
}

void Performance::ShowMenuTo(const geometry::CameraModel& picture) {
  renderer_->SetMenu(menu_.open() ? std::optional(PictureOf(menu_, picture, choices_))
                                  : std::nullopt);
}

Status Performance::OpenSource() {
  if (options_.video.empty() && options_.images.empty()) {
    const auto open = [number = options_.camera.value_or(0), settings = device_.capture] {
      return capture::OpenCamera(number, settings);
    };
    LARARIUM_ASSIGN_OR_RETURN(source_, open());
    source_ = capture::MakeSteady(
        std::move(source_),
        capture::RealWorld(
            open,
            [this](bool connected, const std::string& why) {
              faults_.CameraChanged(connected, why);
            },
            [this](bool steady, double leap) { faults_.ClockChanged(steady, leap); }));
    return Status();
  }
  LARARIUM_ASSIGN_OR_RETURN(source_, options_.video.empty()
                                         ? capture::OpenImageFolder(options_.images)
                                         : capture::OpenVideo(options_.video));
  if (options_.loop) {
    source_ = capture::Loop(std::move(source_));
  }
  return Status();
}

void Performance::TellKiosk() {
  story_length_ = show_->drama().settings().length;
  if (kiosk_) {
    kiosk_->SetStoryLength(story_length_);
  }
}

// What does not go with the languages, but with who watches.
void Performance::TellShow() {
  show_->SetDescriptions(choices_.descriptions);
  show_->SetReducedMotion(choices_.reduced_motion);
}

Status Performance::ChooseHeadset() {
  const bool has_panel = device_.headset && device_.headset->panel;
  const Display display =
      options_.display.value_or(has_panel ? Display::kSideBySide : Display::kMono);
  if (display == Display::kMono) {
    return Status();
  }
  if (display == Display::kOpenXr) {
    headset_ = device_.headset.value_or(Headset());
    headset_->panel.reset();  // its runtime's
    return Status();
  }
  if (!has_panel) {
    return Status::Error("--display side-by-side", "the headset's panel is not known",
                         "give a device file (--device) whose \"headset\" has a \"panel\"");
  }
  headset_ = device_.headset;
  part_ = headset_->SeenPart();
  return Status();
}

// The camera, and what of its view is drawn how large.
Status Performance::ChooseView(const show::ShowContent& content) {
  LARARIUM_RETURN_IF_ERROR(ChooseHeadset());
  LARARIUM_ASSIGN_OR_RETURN(
      const CameraChoice choice,
      ChooseCamera(options_, TrainedCameras(content), source_->width(), source_->height()));
  log_.info("camera intrinsics from {}", choice.origin);
  camera_ = choice.camera;
  const geometry::CameraModel seen = show::PartOfView(camera_, part_);
  // Videos have even sides.
  size_ = options_.size.value_or(
      PictureSize{std::max(seen.width & ~1, 16), std::max(seen.height & ~1, 16)});
  maker_.SetPicture(size_, part_, headset_ && headset_->runtime_shows_room);
  return Status();
}

Status Performance::CreateTracker(const show::ShowContent& content) {
  vision::TrackerOptions tracking;
  tracking.seed = options_.seed;
  tracking.threads = options_.threads;
  tracking.background = options_.pace == Pace::kFast ? vision::BackgroundWork::kJoined
                                                     : vision::BackgroundWork::kFree;
  LARARIUM_ASSIGN_OR_RETURN(poses_,
                            vision::CreateTracker(show::Maps(content.places), camera_, tracking));
  show::SetOccluders(content.places, *poses_);
  poses_ = vision::Smooth(std::move(poses_), show::Maps(content.places), options_.smoothing);
  return Status();
}

// They go before what the last visitor chose.
void Performance::ApplyOptions(Choices& choices) const {
  if (!options_.language.empty()) {
    choices.language = options_.language;
  }
  if (!options_.captions.empty()) {
    choices.captions = options_.captions;
  }
  render::CaptionStyle& style = choices.caption_style;
  style.size = options_.caption_size.value_or(style.size);
  style.contrast = options_.caption_contrast.value_or(style.contrast);
  choices.descriptions = options_.descriptions.value_or(choices.descriptions);
  choices.reduced_motion = options_.reduced_motion.value_or(choices.reduced_motion);
}

// In lock-step nothing may depend on when somebody is read in more detail.
float Performance::FinestDetail() const {
  if (options_.pace == Pace::kFast) {
    return 0.0f;
  }
  const int width = options_.size ? options_.size->width : source_->width();
  return show::FinestDetail(QualityOf(level()), width);
}

// What the last visitor chose may be of another show.
Result<show::ShowContent> Performance::LoadInChosenLanguages() {
  Result<show::ShowContent> loaded = maker_.Load(languages(), FinestDetail());
  if (!loaded.ok() && kiosk_) {
    choices_.language.clear();
    choices_.captions.clear();
    ApplyOptions(choices_);
    loaded = maker_.Load(languages(), FinestDetail());
  }
  if (loaded.ok()) {
    shown_languages_ = languages();
  }
  return loaded;
}

Status Performance::Prepare() {
  if (!options_.device.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(device_, LoadDevice(options_.device));
    maker_.SetDevice(device_);
  }
  LARARIUM_RETURN_IF_ERROR(OpenSource());
  ChooseFirstLevel();
  LARARIUM_ASSIGN_OR_RETURN(const show::ShowContent content, LoadInChosenLanguages());
  LARARIUM_RETURN_IF_ERROR(ChooseView(content));
  for (const show::ShowPlace& place : content.places) {
    statistics_.places.push_back(place.stage.name);
  }
  if (!options_.visitor.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(drama::VisitorLog visitor, drama::VisitorLog::Load(options_.visitor));
    maker_.SetVisitor(std::move(visitor));
  }
  // Drivers take their time, and so does the drama: beside each other.
  std::future<Status> prepared = std::async(std::launch::async, [&]() -> Status {
    LARARIUM_RETURN_IF_ERROR(CreateTracker(content));
    LARARIUM_ASSIGN_OR_RETURN(show_, maker_.Make(content));
    return Status();
  });
  const Status drawing = PrepareDrawing(content);
  const Status playing = prepared.get();
  LARARIUM_RETURN_IF_ERROR(playing);
  LARARIUM_RETURN_IF_ERROR(drawing);
  TellKiosk();
  TellShow();
  if (kiosk_ && kiosk_->ResumeAt(content.title) > 0.0) {
    show_->RestartAt(kiosk_->ResumeAt(content.title));
  }
  SetLevel(level());
  LARARIUM_ASSIGN_OR_RETURN(recorder_, Recorder::Create(options_, *source_, shown(), *show_));
  OpenSound();
  if (!options_.osc.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const ListenAddress address,
                              ParseListenAddress("--osc", options_.osc));
    LARARIUM_ASSIGN_OR_RETURN(osc_, OscListener::Open(address, log_));
  }
  return Status();
}

Status Performance::PrepareDrawing(const show::ShowContent& content) {
  LARARIUM_ASSIGN_OR_RETURN(screen_, Screen::Open(options_, content.title));
  LARARIUM_ASSIGN_OR_RETURN(target_, render::RenderTarget::Create(size_.width, size_.height));
  if (staff_) {
    staff_->Prepare(*target_);
  }
  Result<std::unique_ptr<show::ShowRenderer>> renderer =
      show::ShowRenderer::Create(content, QualityOf(level()));
  if (!renderer.ok()) {
    return renderer.status().At(options_.show.string());
  }
  renderer_ = *std::move(renderer);
  renderer_->SetEvidence(options_.evidence);
  renderer_->SetCaptionStyle(choices_.caption_style);
  renderer_->SetPart(part_);
  if (headset_ && headset_->panel) {
    LARARIUM_ASSIGN_OR_RETURN(stereo_, StereoDisplay::Create(*headset_));
    screen_->CheckSize(stereo_->panel(), log_);
  } else if (headset_) {
    LARARIUM_ASSIGN_OR_RETURN(openxr_, OpenXrDisplay::Open(*headset_, content.title, log_));
  }
  statistics_.gpu = render::GraphicsDeviceName();
  statistics_.graphics = render::Name(render::CurrentGraphicsApi());
  log_.info("drawn with {} by {}", statistics_.graphics, statistics_.gpu);
  return Status();
}

// In lock-step the level does not depend on how long anything takes.
void Performance::ChooseFirstLevel() {
  if (!options_.quality && options_.pace != Pace::kFast) {
    // From the coarsest, so that no visitor waits for pictures that this machine cannot draw.
    const size_t levels = render::QualityLadder().size();
    quality_.emplace(show::QualityOptions::ForCamera(levels, source_->frames_per_second()),
                     levels - 1);
    power_.emplace(kPowerSeconds);
  }
}

void Performance::SetLevel(size_t level) {
  heartbeat_.BeatBeforeLongWork();  // drivers may have to compile for it
  const render::Quality& quality = QualityOf(level);
  renderer_->SetQuality(quality);
  show_->SetQuality(quality);
}

void Performance::ChooseQuality(SteadyClock::time_point now, double work_ms) {
  if (!quality_) {
    return;
  }
  const double time = Seconds(now);
  const size_t before = quality_->level();
  quality_->AddFrame(time, work_ms);
  if (const std::optional<show::PowerState> power = power_->Take()) {
    quality_->SetPower(time, *power);
  }
  if (quality_->level() != before) {
    const show::QualityStep& step = quality_->steps().back();
    log_.info("quality {} instead of {}: {}", quality_->level(), before, show::Name(step.reason));
    SetLevel(quality_->level());
  }
}

// Another language needs other texts and voices. The show goes on while they are read.
void Performance::BeginChangingLanguages() {
  next_languages_ = languages();
  next_show_ = std::async(std::launch::async,
                          [this, languages = next_languages_, finest = FinestDetail(),
                           time = drama_time_] { return maker_.MakeAt(time, languages, finest); });
}

// In lock-step a frame does not depend on how long anything takes.
bool Performance::OtherLanguagesAreReady() {
  if (!next_show_.valid() && languages() != shown_languages_) {
    BeginChangingLanguages();
  }
  return next_show_.valid() &&
         (options_.pace == Pace::kFast ||
          next_show_.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
}

// The drama goes on where it is. While no frame is under way.
Status Performance::ChangeLanguages() {
  heartbeat_.BeatBeforeLongWork();
  Result<std::unique_ptr<show::Show>> next = next_show_.get();
  if (!next.ok()) {
    log_.warn("{}; the languages stay", next.message());
    Choices choices = choices_;
    choices.language = shown_languages_.spoken;
    choices.captions = shown_languages_.captions;
    Change(choices);
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR((*next)->GoOnFrom(*show_));
  LARARIUM_RETURN_IF_ERROR(recorder_->SetShow(**next));
  sound_.reset();
  show_ = std::move(*next);
  shown_languages_ = next_languages_;
  TellKiosk();
  TellShow();
  show_->SetQuality(QualityOf(level()));
  OpenSound();
  log_.info("language '{}', captions '{}'", shown_languages_.spoken, shown_languages_.captions);
  menu_.SetItems(ItemsOf(show_->content(), choices_));
  return renderer_->SetTexts(show_->content());
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
  SetVolume();
}

void Performance::ShowToStaff() {
  char more[64];
  const double rate =
      statistics_.interval.count() == 0 ? 0.0 : 1000.0 / statistics_.interval.mean();
  std::snprintf(more, sizeof(more), "   quality %zu   %.0f/s", level(), rate);
  renderer_->SetStaff(more);
}

void Performance::AddTimes(const show::StagedFrame& staged, SteadyClock::time_point drawn) {
  const SteadyClock::time_point now = SteadyClock::now();
  const auto milliseconds = [](SteadyClock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
  };
  statistics_.located_age.Add(milliseconds(staged.located - staged.arrival));
  statistics_.staged_age.Add(milliseconds(staged.staged - staged.arrival));
  statistics_.drawn_age.Add(milliseconds(drawn - staged.arrival));
  statistics_.shown_age.Add(milliseconds(now - staged.arrival));
  statistics_.total.Add(milliseconds(now - staged.arrival));
  if (drawn_frames_ == 0) {
    statistics_.startup_seconds = Seconds(now);
  } else {
    statistics_.interval.Add(milliseconds(now - last_shown_));
  }
  last_shown_ = now;
  ++drawn_frames_;
}

// Also between two images of the camera.
Status Performance::ServeOpenXr() {
  if (openxr_ != nullptr) {
    LARARIUM_ASSIGN_OR_RETURN(const bool more, openxr_->headset().Frame());
    if (!more) {
      log_.info("the headset's runtime ended the session");
      g_end_requested = 1;
    }
    for (const std::string& button : openxr_->headset().TakeButtons()) {
      PressKey(button);
    }
  }
  return Status();
}

Status Performance::DrawPicture(const show::StagedFrame& staged) {
  if (openxr_ != nullptr) {
    return openxr_->Draw(staged, *renderer_, *target_, Seconds(SteadyClock::now()), Shown(),
                         [this](const geometry::CameraModel& eye) { ShowMenuTo(eye); });
  }
  return stereo_ ? stereo_->Draw(staged, *renderer_, *target_) : renderer_->Draw(staged, *target_);
}

// Tells the kiosk, whose next visitor may have come.
void Performance::AfterFrame(const show::StagedFrame& staged) {
  if (!kiosk_) {
    return;
  }
  kiosk_->AfterFrame(Seconds(last_shown_), staged, *show_);
  if (kiosk_->TakeNewVisitor()) {
    menu_.Close();
    Change(house_);
  }
  SetVolume();
}

Status Performance::DrawFrame(show::StagedFrame& staged) {
  if (kiosk_) {
    kiosk_->BeforeFrame(staged);
  }
  drama_time_ = staged.time;
  if (options_.staff) {
    ShowToStaff();
  }
  ShowMenu(staged);
  if (draw_ms_ > kSlowPicture) {
    heartbeat_.BeatBeforeLongWork();
  }
  const SteadyClock::time_point begin = SteadyClock::now();
  SteadyClock::time_point drawn;
  {
    const ScopedStageTimer timer(statistics_.render);
    LARARIUM_RETURN_IF_ERROR(DrawPicture(staged));
    target_->Finish();
    drawn = SteadyClock::now();
    screen_->Present(shown());
  }
  if (sound_ != nullptr) {
    sound_->Show(staged.sound);
  }
  AddTimes(staged, drawn);
  faults_.AfterFrame(staged.tracked);
  draw_ms_ = std::chrono::duration<double, std::milli>(drawn - begin).count();
  ChooseQuality(last_shown_, std::max(draw_ms_, staged.stage_ms));
  heartbeat_.Beat();
  AfterFrame(staged);
  TellStaff(staged);
  if (drawn_frames_ == kFirstFrames) {
    render::ReleaseShaderCompiler();
    AfterFirstPictures();
  }
  return recorder_->Add(staged, shown());
}

Status Performance::RunLockStep() {
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

Status Performance::RunRealtime() {
  std::optional<show::RealtimePipeline> pipeline(std::in_place, stages());
  while (!pipeline->Finished() && KeepGoing(pipeline->LongestWork())) {
    if (OtherLanguagesAreReady()) {
      pipeline.reset();
      LARARIUM_RETURN_IF_ERROR(ChangeLanguages());
      pipeline.emplace(stages());
    }
    LARARIUM_RETURN_IF_ERROR(ServeOpenXr());
    // A headset's own frames are waited for already.
    const auto wait = openxr_ != nullptr ? std::chrono::milliseconds(0) : kInputInterval;
    if (std::unique_ptr<show::StagedFrame> staged = pipeline->Take(wait)) {
      LARARIUM_RETURN_IF_ERROR(DrawFrame(*staged));
      pipeline->Recycle(std::move(staged));
    }
  }
  pipeline->Stop();
  return pipeline->status();
}

Status Performance::Run() {
  LARARIUM_RETURN_IF_ERROR(options_.pace == Pace::kFast ? RunLockStep() : RunRealtime());
  if (openxr_ != nullptr) {
    LARARIUM_RETURN_IF_ERROR(openxr_->headset().End());
  }
  LARARIUM_RETURN_IF_ERROR(recorder_->Finish());
  if (quality_) {
    statistics_.quality = quality_->ToJson();
  }
  if (!options_.stats_out.empty()) {
    LARARIUM_RETURN_IF_ERROR(SaveJson(options_.stats_out, statistics_.ToJson()));
  }
  if (!options_.visitor_log.empty()) {
    LARARIUM_RETURN_IF_ERROR(
        WriteFileAtomically(options_.visitor_log, show_->drama().visitor_log().Write()));
  }
  log_.info("{} frames shown, {:.1f} % tracked", drawn_frames_,
            100.0 * statistics_.tracking.tracked_fraction());
  return begin_again_ ? Status::Error("staff page", "the player is to begin again") : Status();
}

void WarnOf(const Status& status, Log& log) {
  if (!status.ok()) {
    log.warn("{}", status.message());
  }
}

}  // namespace

Status Play(const PlayOptions& options,
            SteadyClock::time_point started,
            Log& log,
            const ChildStart& start,
            Heartbeat heartbeat,
            int staff_link) {
  std::signal(SIGINT, RequestEnd);
  std::signal(SIGTERM, RequestEnd);
  std::optional<ThreadLimit> limit;
  if (options.threads > 0) {
    limit.emplace(options.threads);
  }
  const bool sandbox = options.sandbox && options.display != Display::kOpenXr;
  if (options.sandbox && !sandbox) {
    log.info("no sandbox: the headset's runtime needs the system");
  }
  Performance performance(options, started, log, start, heartbeat, staff_link);
  if (sandbox) {
    WarnOf(EnterOpeningSandbox(), log);
  }
  BeginLoading();
  LARARIUM_RETURN_IF_ERROR(performance.Prepare());
  BeginPlaying();
  if (sandbox) {
    WarnOf(EnterSandbox(), log);
  }
  return performance.Run();
}

}  // namespace lararium::player
