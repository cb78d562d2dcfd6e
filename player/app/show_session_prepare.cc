#include <algorithm>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "player/app/camera_choice.h"
#include "player/app/show_session.h"
#include "shared/capture/looped_source.h"
#include "shared/capture/steady_camera.h"
#include "shared/vision/pose_smoother.h"
#include "shared/vision/tracker.h"

namespace lararium::player {
namespace {

constexpr double kPowerSeconds = 5.0;

std::vector<TrainedCamera> TrainedCameras(const show::ShowContent& content) {
  std::vector<TrainedCamera> cameras;
  for (const show::ShowPlace& place : content.places) {
    cameras.push_back({place.stage.name, place.map->camera});
  }
  return cameras;
}

}  // namespace

Status ShowSession::OpenSource() {
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

Status ShowSession::ChooseHeadset() {
  const bool has_panel = device_.headset && device_.headset->panel;
  const Display display =
      options_.display.value_or(has_panel ? Display::kSideBySide : Display::kMono);
  if (display == Display::kMono) {
    return Status();
  }
  if (display == Display::kOpenXr) {
    headset_ = device_.headset.value_or(Headset());
    headset_->panel.reset();  // the runtime knows the panel
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

// Chooses the camera's calibration, the part of its view that is drawn, and the size of pictures.
Status ShowSession::ChooseView(const show::ShowContent& content) {
  LARARIUM_RETURN_IF_ERROR(ChooseHeadset());
  LARARIUM_ASSIGN_OR_RETURN(
      const CameraChoice choice,
      ChooseCamera(options_, TrainedCameras(content), source_->width(), source_->height()));
  log_.info("camera intrinsics from {}", choice.origin);
  camera_ = choice.camera;
  const geometry::CameraModel seen = show::PartOfView(camera_, part_);
  // Width and height of videos must be even.
  size_ = options_.size.value_or(
      PictureSize{std::max(seen.width & ~1, 16), std::max(seen.height & ~1, 16)});
  maker_.SetPicture(size_, part_, headset_ && headset_->runtime_shows_room);
  return Status();
}

Status ShowSession::CreateTracker(const show::ShowContent& content) {
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

// Options take precedence over the choices of the last visitor.
void ShowSession::ApplyOptions(Choices& choices) const {
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

// In lock-step nothing may depend on the time at which a finer level of detail is loaded.
float ShowSession::FinestDetail() const {
  if (options_.pace == Pace::kFast) {
    return 0.0f;
  }
  const int width = options_.size ? options_.size->width : source_->width();
  return show::FinestDetail(QualityOf(level()), width);
}

// The choices of a kiosk's last visitor may belong to another show, so loading may fail with them.
Result<show::ShowContent> ShowSession::LoadInChosenLanguages() {
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

Status ShowSession::Prepare() {
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
  // Drivers and the drama both need time to start, so they are prepared in parallel.
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
    show_->input().RestartAt(kiosk_->ResumeAt(content.title));
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

Status ShowSession::PrepareDrawing(const show::ShowContent& content) {
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

// In lock-step the level must not depend on the time that anything takes.
void ShowSession::ChooseFirstLevel() {
  if (!options_.quality && options_.pace != Pace::kFast) {
    // Starts at the coarsest level, so that visitors never wait for pictures that are too slow.
    const size_t levels = render::QualityLadder().size();
    quality_.emplace(show::QualityOptions::ForCamera(levels, source_->frames_per_second()),
                     levels - 1);
    power_.emplace(kPowerSeconds);
  }
}

// Another language needs other texts and voices. The show continues while they are loaded.
void ShowSession::BeginChangingLanguages() {
  next_languages_ = languages();
  next_show_ = std::async(std::launch::async,
                          [this, languages = next_languages_, finest = FinestDetail(),
                           time = drama_time_] { return maker_.MakeAt(time, languages, finest); });
}

// In lock-step a frame must not depend on the time that loading takes, so it is waited for.
bool ShowSession::OtherLanguagesAreReady() {
  if (!next_show_.valid() && languages() != shown_languages_) {
    BeginChangingLanguages();
  }
  return next_show_.valid() &&
         (options_.pace == Pace::kFast ||
          next_show_.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
}

// The drama continues at the same time. Call this while no frame is being staged or drawn.
Status ShowSession::ChangeLanguages() {
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
  LARARIUM_RETURN_IF_ERROR((*next)->ResumeFrom(*show_));
  LARARIUM_RETURN_IF_ERROR(recorder_->SetShow(**next));
  sound_.reset();
  show_ = std::move(*next);
  shown_languages_ = next_languages_;
  TellKiosk();
  TellShow();
  show_->detail().SetQuality(QualityOf(level()));
  OpenSound();
  log_.info("language '{}', captions '{}'", shown_languages_.spoken, shown_languages_.captions);
  menu_.SetItems(ItemsOf(show_->content(), choices_));
  return renderer_->SetTexts(show_->content());
}

// Failing to open sound is not an error: the show is played without it.
void ShowSession::OpenSound() {
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

}  // namespace lararium::player
