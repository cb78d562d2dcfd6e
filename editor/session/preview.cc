#include "editor/session/preview.h"

#include <algorithm>
#include <chrono>
#include <set>
#include <string>
#include <utility>

#include "shared/audio/audio_out.h"
#include "shared/audio/mixer.h"
#include "shared/audio/sound_player.h"
#include "shared/capture/frame_source.h"
#include "shared/core/memory.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"
#include "shared/show/lod_streamer.h"
#include "shared/show/show.h"
#include "shared/show/show_renderer.h"
#include "shared/vision/foreground/foreground_mask.h"
#include "shared/vision/photometry.h"
#include "shared/vision/tracker.h"

namespace lararium::editor {

namespace {

constexpr float kOnionTint = 0.7f;  // Share of the tint in skins.

// Small pictures show at most half of the textures' resolution, unless a person is half a metre
// away.
render::Quality QualityFor(int width) {
  constexpr int kSmall = 800;  // Pixels.
  return {.texture_halvings = width <= kSmall ? 1 : 0};
}

}  // namespace

// Everything that the preview's thread owns.
class Preview::Worker {
 public:
  static Result<std::unique_ptr<Worker>> Create(const Opener& open,
                                                show::ShowContent content,
                                                Log& log);

  PreviewSource source() const {
    return {end_.value_or(source_->estimated_frame_count()), source_->frames_per_second(),
            source_->live()};
  }

  show::LodStreamer::Reading reading_finer() const { return show_->detail().reading_finer(); }

  // Returns nullptr for a frame beyond the end.
  Result<std::shared_ptr<const PreviewPicture>> Draw(const PreviewRequest& request);

  // New errors of the drama. Errors that were reported before are left out, because seeking plays
  // the drama again. An invalid script or a floor on which people cannot walk is reported each
  // time.
  std::vector<Status> TakeErrors();

 private:
  Worker() = default;

  // Sets tracked_ to a frame, or to a live camera's newest frame. Does nothing where it is the
  // present frame. Beyond the end tracked_ is reset.
  Status Track(int64_t frame);
  PreviewPicture Describe() const;
  void PlaceObjects(const std::vector<PreviewObject>& objects);
  void TakeScript(std::shared_ptr<const std::string> script);
  // Adds the images for comparison to the picture that was just drawn.
  Status Compare(PreviewPicture& picture);
  // Draws other moments over the picture that was just drawn. coverage: of the people in that
  // picture.
  Status LayOnionSkin(const OnionSkin& skin, const cv::Mat& coverage, cv::Mat& picture);
  // Adds the frame that was just tracked to the trails.
  void NoteTrails(int64_t frame);
  // Plays the sound of the present frame, or silence.
  void PlaySound(bool on);

  std::unique_ptr<capture::FrameSource> source_;
  std::unique_ptr<vision::PoseSource> poses_;
  std::unique_ptr<show::Show> show_;
  std::optional<render::OffscreenContext> context_;  // Declared before all members that draw.
  std::unique_ptr<show::ShowRenderer> renderer_;
  std::optional<render::RenderTarget> target_;
  std::shared_ptr<const stage::Place> place_;
  std::optional<int64_t> end_;  // The exact number of frames, once known.
  std::optional<vision::TrackedFrame> tracked_;
  std::vector<vision::SeenPoint> seen_;  // Pixels of the picture.
  PointTrails trails_;
  show::StagedFrame staged_;
  show::StagedFrame other_;                    // Another moment, for an onion skin.
  std::shared_ptr<const std::string> script_;  // The last requested text.
  Status script_problem_;                      // Why the previous script still runs.
  Status floor_problem_;                       // Why people cannot walk.
  std::set<std::string> told_;                 // Script errors that were reported.
  Log* log_ = nullptr;
  bool sounds_ = false;                        // sound_ plays the present moment.
  bool mute_ = false;                          // Mixing is not possible.
  std::unique_ptr<audio::SoundPlayer> sound_;  // Set after the first request for sound.
};

Result<std::unique_ptr<Preview::Worker>> Preview::Worker::Create(const Opener& open,
                                                                 show::ShowContent content,
                                                                 Log& log) {
  std::unique_ptr<Worker> worker(new Worker);
  worker->log_ = &log;
  LARARIUM_ASSIGN_OR_RETURN(worker->source_, open());
  LARARIUM_ASSIGN_OR_RETURN(const geometry::CameraModel camera,
                            content.places.front().map->camera.ForImages(
                                worker->source_->width(), worker->source_->height()));
  LARARIUM_ASSIGN_OR_RETURN(auto tracker,
                            vision::CreateTracker(show::Maps(content.places), camera, {}));
  worker->poses_ = vision::WithForeground(std::move(tracker), show::Maps(content.places));
  show::SetOccluders(content.places, *worker->poses_);
  drama::DramaOptions drama;
  drama.past = drama::Past::kRepeated;  // Seeking to and fro must give the same state.
  LARARIUM_ASSIGN_OR_RETURN(worker->show_, show::Show::Create(std::move(content), drama, log));
  LARARIUM_ASSIGN_OR_RETURN(worker->context_, render::CreateOffscreenContext());
  const render::DrawingTurn turn(*worker->context_);
  LARARIUM_ASSIGN_OR_RETURN(
      worker->renderer_,
      show::ShowRenderer::Create(worker->show_->content(), QualityFor(worker->source_->width())));
  LARARIUM_ASSIGN_OR_RETURN(
      worker->target_,
      render::RenderTarget::Create(worker->source_->width(), worker->source_->height()));
  return worker;
}

Status Preview::Worker::Track(int64_t frame) {
  const bool live = source_->live();
  if (!live && tracked_ && tracked_->frame.index == frame) {
    return Status();
  }
  const bool follows = live || (tracked_ && tracked_->frame.index + 1 == frame);
  if (!follows) {
    LARARIUM_RETURN_IF_ERROR(source_->Seek(frame));
  }
  LARARIUM_ASSIGN_OR_RETURN(std::optional<geometry::Frame> image, source_->Next());
  if (!image) {
    tracked_.reset();
    end_ = frame;
    return Status();
  }
  tracked_ = poses_->Track(*image);
  NoteTrails(tracked_->frame.index);
  return Status();
}

void Preview::Worker::NoteTrails(int64_t frame) {
  poses_->Seen(seen_);
  const geometry::CameraModel display = tracked_->camera.DisplayPinhole();
  for (vision::SeenPoint& point : seen_) {
    const Eigen::Vector2d plane = tracked_->camera.PlaneFromPixel(point.pixel.cast<double>());
    point.pixel = display.PixelFromPlane(plane).cast<float>();
  }
  trails_.Add(frame, tracked_->map, seen_);
}

PreviewPicture Preview::Worker::Describe() const {
  PreviewPicture picture;
  picture.frame = staged_.tracked.frame.index;
  picture.display = staged_.tracked.camera.DisplayPinhole();
  picture.name = source_->FrameName(picture.frame);
  picture.camera = staged_.tracked.camera;
  picture.grey = staged_.tracked.frame.grey;
  picture.state = staged_.tracked.state;
  picture.reason = staged_.tracked.reason;
  picture.inliers = staged_.tracked.inliers;
  picture.followed = staged_.tracked.followed;
  picture.confidence = staged_.tracked.confidence;
  picture.camera_from_map = staged_.tracked.camera_from_map;
  picture.camera_from_stage = staged_.camera.camera_from_stage;
  picture.gain = staged_.camera.gain;
  picture.trails = trails_.trails();
  for (const show::StagedActor& actor : staged_.people.actors) {
    const auto skin = staged_.people.skin.begin() + actor.skin_begin;
    picture.actors.push_back(
        {actor.figure, actor.stage_from_actor, {skin, skin + actor.skin_count}});
  }
  return picture;
}

Status Preview::Worker::Compare(PreviewPicture& picture) {
  staged_.camera.camera_from_stage.reset();  // People are not drawn without a pose.
  LARARIUM_RETURN_IF_ERROR(renderer_->Draw(staged_, *target_));
  target_->ReadPixels(picture.plain);
  return Status();
}

Status Preview::Worker::LayOnionSkin(const OnionSkin& skin,
                                     const cv::Mat& coverage,
                                     cv::Mat& picture) {
  cv::Mat overlay, overlay_coverage;
  for (const OnionMoment& moment : OnionMoments(skin, staged_.time)) {
    LARARIUM_RETURN_IF_ERROR(show_->StageAtTime(staged_.time + moment.offset, staged_, other_));
    RemoveUnmoved(staged_, other_);
    if (other_.people.actors.empty() && other_.things.objects.empty()) {
      continue;
    }
    render::SceneMark mark;
    for (int c = 0; c < 3; ++c) {
      mark.colour[c] =
          vision::LinearFromSrgb(cv::saturate_cast<uint8_t>(255.0f * moment.colour[c]));
    }
    mark.share = kOnionTint;
    LARARIUM_RETURN_IF_ERROR(renderer_->DrawOverlays(other_, mark, *target_));
    target_->ReadPixels(overlay);
    renderer_->ReadCoverage(overlay_coverage);
    BlendOverlay(overlay, overlay_coverage, coverage, moment.opacity, picture);
  }
  return Status();
}

// There is no sound while seeking or paused.
void Preview::Worker::PlaySound(bool on) {
  if (on && sound_ == nullptr && !mute_ && !show_->sounds()->clips().empty()) {
    Result<std::unique_ptr<audio::Mixer>> mixer = audio::Mixer::Create(show_->sounds(), {});
    mute_ = !mixer.ok();
    if (mute_) {
      log_->Warn("{}; the preview is silent", mixer.message());
      return;
    }
    sound_ = std::make_unique<audio::SoundPlayer>(
        std::move(*mixer), [] { return audio::CreateAudioOut(audio::AudioOutKind::kDevice); },
        *log_);
  }
  if (sound_ != nullptr && (on || sounds_)) {
    audio::SoundScene silence;
    silence.held = true;
    sound_->Show(on ? staged_.sound : silence);
  }
  sounds_ = on;
}

void Preview::Worker::PlaceObjects(const std::vector<PreviewObject>& objects) {
  const std::vector<show::StageObject>& staged = show_->content().objects;
  for (size_t i = 0; i < staged.size(); ++i) {
    const auto placed =
        std::find_if(objects.begin(), objects.end(),
                     [&](const PreviewObject& object) { return object.name == staged[i].name; });
    if (placed != objects.end()) {
      show_->PlaceObject(i, placed->stage_from_object);
    }
  }
}

void Preview::Worker::TakeScript(std::shared_ptr<const std::string> script) {
  if (script == nullptr || script == script_) {
    return;
  }
  const bool is_running = *script == (script_ != nullptr ? *script_ : show_->content().drama);
  script_ = std::move(script);
  if (!is_running) {
    told_.clear();
    script_problem_ = show_->Reload(*script_);
  }
}

Result<std::shared_ptr<const PreviewPicture>> Preview::Worker::Draw(const PreviewRequest& request) {
  if (request.place != nullptr && request.place != place_) {
    place_ = request.place;
    show_->SetPlace(0, *place_);
    {
      const render::DrawingTurn turn(*context_);
      renderer_->SetPlace(0, *place_);
    }
    poses_->SetOccluders(0, show::OccludersInMap(*place_));
  }
  PlaceObjects(request.objects);
  if (request.settled) {
    if (Status status = show_->LayFloor(); !status.ok()) {
      floor_problem_ = std::move(status);
    }
  }
  TakeScript(request.script);
  LARARIUM_RETURN_IF_ERROR(Track(request.frame));
  if (!tracked_) {
    return std::shared_ptr<const PreviewPicture>();
  }
  show_->input().SetDescriptions(request.descriptions);
  show_->StageFrame(*tracked_, request.time, staged_);
  PlaySound(request.sound);
  const render::DrawingTurn turn(*context_);
  renderer_->SetEvidence(request.evidence);
  LARARIUM_RETURN_IF_ERROR(renderer_->Draw(staged_, *target_));
  PreviewPicture picture = Describe();
  picture.time = request.time;
  target_->ReadPixels(picture.bgr);
  const bool onion = request.onion && staged_.camera.camera_from_stage;
  if (request.compare || onion) {
    renderer_->ReadCoverage(picture.coverage);
  }
  if (onion) {
    LARARIUM_RETURN_IF_ERROR(LayOnionSkin(*request.onion, picture.coverage, picture.bgr));
  }
  if (request.compare) {
    LARARIUM_RETURN_IF_ERROR(Compare(picture));
  }
  return std::make_shared<const PreviewPicture>(std::move(picture));
}

std::vector<Status> Preview::Worker::TakeErrors() {
  std::vector<Status> errors;
  for (Status* problem : {&script_problem_, &floor_problem_}) {
    if (!problem->ok()) {
      errors.push_back(std::exchange(*problem, Status()));
    }
  }
  for (const drama::ScriptError& error : show_->drama().errors()) {
    if (told_.insert(error.message).second) {
      errors.push_back(Status::Error("drama", error.message));
    }
  }
  return errors;
}

float Preview::FinestDetail(const vision::SceneDatabase& map) {
  return show::FinestDetail(QualityFor(map.camera.width), map.camera.width);
}

Preview::Preview(Opener open, show::ShowContent content, Log& log)
    : open_(std::move(open)),
      content_(std::move(content)),
      log_(log),
      thread_([this](std::stop_token stop) { Run(stop); }) {}

Preview::~Preview() {
  thread_.request_stop();
  thread_.join();
}

void Preview::Run(std::stop_token stop) {
  Result<std::unique_ptr<Worker>> worker = Worker::Create(open_, std::move(content_), log_);
  if (!worker) {
    AddProblem(worker.status());
    failed_ = true;
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    source_ = (*worker)->source();
  }
  TrimHeap();  // Also frees memory of the preview before this one.
  const bool live = (*worker)->source().live;
  constexpr int kFirstPictures = 3;
  int pictures = 0;
  std::optional<PreviewRequest> drawn;
  while (std::optional<PreviewRequest> request = NextRequest(drawn, **worker, stop)) {
    Result<std::shared_ptr<const PreviewPicture>> picture = (*worker)->Draw(*request);
    drawn.reset();
    if (live && (!picture.ok() || *picture == nullptr)) {
      AddProblem(picture.ok() ? Status::Error("the camera", "gives no more images")
                              : picture.status());
      failed_ = true;
      return;
    }
    if (!picture.ok()) {
      AddProblem(picture.status());
    } else if (*picture != nullptr) {
      drawn = std::move(request);
      pictures_.Put(std::move(*picture));
      if (++pictures == kFirstPictures) {  // They compile the shaders.
        render::ReleaseShaderCompiler();
        TrimHeap();
      }
      for (Status& problem : (*worker)->TakeErrors()) {
        AddProblem(std::move(problem));
      }
    } else {
      const std::lock_guard lock(mutex_);
      source_ = (*worker)->source();
    }
  }
}

// A live camera gives a new image each time. A still picture is drawn again when a person was read
// in more detail for it.
std::optional<PreviewRequest> Preview::NextRequest(const std::optional<PreviewRequest>& drawn,
                                                   const Worker& worker,
                                                   std::stop_token stop) {
  using Reading = show::LodStreamer::Reading;
  constexpr std::chrono::milliseconds kGlance(20);
  const bool live = worker.source().live;
  while (drawn && !live && worker.reading_finer() == Reading::kSomebody && !stop.stop_requested()) {
    if (std::optional<PreviewRequest> next = requests_.TakeFor(kGlance)) {
      return next;
    }
  }
  if (!drawn || !(live || worker.reading_finer() == Reading::kDone)) {
    return requests_.Take(stop);
  }
  if (stop.stop_requested()) {
    return std::nullopt;
  }
  std::optional<PreviewRequest> newest = requests_.TryTake();
  return newest ? std::move(newest) : drawn;
}

void Preview::AddProblem(Status problem) {
  const std::lock_guard lock(mutex_);
  problems_.push_back(std::move(problem));
}

std::optional<PreviewSource> Preview::source() const {
  const std::lock_guard lock(mutex_);
  return source_;
}

std::vector<Status> Preview::TakeProblems() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problems_, {});
}

}  // namespace lararium::editor
