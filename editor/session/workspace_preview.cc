#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/document/file_stamp.h"
#include "editor/document/frame_times.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/drawn_occluder.h"
#include "editor/jobs/filming.h"
#include "editor/jobs/object_pose.h"
#include "editor/jobs/sounds.h"
#include "editor/session/workspace.h"

namespace lararium::editor {

std::string Workspace::PreviewKey() const {
  // Without drafts, because each new corner would open the preview again.
  const PlaceDocument at = WithoutDrafts(*place(), *loaded_.database);
  Json key = {{"place", at.name},
              {"map", map_loads_},
              {"training", at.training.path},
              {"preview", {static_cast<int>(at.preview.kind), at.preview.path}},
              {"view", {static_cast<int>(view_source_), live_camera_}},
              {"languages", {document().speech.spoken, document().speech.captions}}};
  for (const char* file : {"lines.csv", "lines.json", "paradata.json"}) {
    key["texts"].push_back(FileStamp(paths_.folder / file));
  }
  for (const SoundFile& sound : FindSounds(paths_)) {
    key["sounds"].push_back({sound.name, sound.built_in ? "" : FileStamp(sound.file)});
  }
  for (const OccluderDocument& occluder : at.occluders) {
    // Sizes and effects of a shape can change without opening the preview again.
    Json& entry = key["occluders"].emplace_back(
        Json::array({occluder.name, occluder.file, occluder.shape.has_value()}));
    if (occluder.drawn()) {
      // The depth is in metres, the map is not.
      const double scale = loaded_.picks.map_from_picked.scale * at.picked_from_stage.scale;
      entry.push_back({FormatOccluder(occluder)["corners"], occluder.depth * scale, occluder.flat});
    }
  }
  for (const ProbeDocument& probe : at.probes) {
    // Rotation and brightness can change without opening the preview again.
    key["probes"].push_back({probe.name, probe.file, FileStamp(paths_.Resolve(probe.file))});
  }
  for (const CastDocument& member : document().cast) {
    key["cast"].push_back(FormatCastMember(member));
  }
  for (const ObjectDocument& object : document().objects) {
    // The pose can change without opening the preview again.
    key["objects"].push_back({object.name, object.model, object.file,
                              object.file.empty() ? "" : FileStamp(paths_.Resolve(object.file))});
  }
  return key.dump();
}

void Workspace::ReloadPreview() {
  preview_stale_ = false;
  if (place() == nullptr || loaded_.database == nullptr) {
    return;
  }
  std::string key = PreviewKey();
  if (key == preview_key_) {
    return;
  }
  const auto content = std::make_shared<show::ShowContent>();
  const auto report = std::make_shared<BakeReport>();
  const auto missing = std::make_shared<size_t>(0);  // Number of people with a replacement.
  const auto work = [content, report, missing, others_stand_in = PeopleLeft() > 0, paths = paths_,
                     document = commands_.snapshot(), script = script_.snapshot(),
                     name = place_name_, database = loaded_.database, baking = baking_,
                     map_from_picked = loaded_.picks.map_from_picked](Progress& progress) {
    *missing = others_stand_in ? PeopleToBake(paths, *document).size() : 0;
    if (*missing == 0) {
      const std::lock_guard turn(*baking);
      LARARIUM_ASSIGN_OR_RETURN(*report, editor::Bake(paths, *document, progress));
    } else {
      LARARIUM_ASSIGN_OR_RETURN(*report,
                                editor::Bake(paths, *document, progress, BakeWhat::kAllButPeople));
    }
    const PlaceDocument place = WithoutDrafts(*document->FindPlace(name), *database);
    LARARIUM_ASSIGN_OR_RETURN(
        *content, AssembleShow(paths, *document, place, database, map_from_picked,
                               {.unbuilt = *missing > 0 ? Unbuilt::kStandsIn : Unbuilt::kFails,
                                .finest = Preview::FinestDetail(*database)}));
    content->drama = *script;  // The present text, saved or not.
    return Status();
  };
  const auto done = [this, content, report, missing, revision = script_.revision(),
                     document = commands_.snapshot(),
                     name = place_name_](const Status& status, bool cancelled) {
    stand_ins_ = *missing;
    if (!status.ok()) {
      Report(status, cancelled, "");
      return;
    }
    for (const std::string& warning : report->warnings) {
      Tell(Message::Level::kWarning, warning);
    }
    if (name != place_name_ || place() == nullptr) {
      preview_stale_ = true;
      return;
    }
    loaded_.staged = std::make_shared<const stage::Place>(content->places.front().stage);
    loaded_.baked_probes = document->FindPlace(name)->probes;
    loaded_.baked_light = loaded_.staged->probes;
    preview_ = std::make_unique<Preview>(ViewOpener(), std::move(*content), log_);
    previewed_script_ = revision;
    requested_frame_ = -1;
    place_changed_ = true;
    stage_changed_ = true;
  };
  if (tasks_.Start(TaskKind::kOpening, work, done)) {
    preview_key_ = std::move(key);
  } else {
    preview_stale_ = true;  // Try again after the running task.
  }
}

bool Workspace::has_own_recording() const {
  return place() != nullptr && !place()->preview.empty() &&
         (place()->preview.kind != place()->training.kind ||
          paths_.Resolve(place()->preview.path) != paths_.Resolve(place()->training.path));
}

Preview::Opener Workspace::ViewOpener() {
  if (view_source_ == ViewSource::kLive) {
    camera_presence_ = std::make_shared<CameraPresence>(true);
    return [camera = live_camera_, presence = camera_presence_] {
      return OpenLiveCamera(camera, presence);
    };
  }
  const bool training = view_source_ == ViewSource::kTraining || !has_own_recording();
  return [paths = paths_, source = training ? place()->training : place()->preview] {
    return OpenSource(paths, source);
  };
}

void Workspace::PreviewLiveCamera(const std::string& camera) {
  SetViewSource(ViewSource::kRecording);
  live_camera_ = IsCameraNumber(camera) ? camera : paths_.Resolve(camera).string();
  SetViewSource(ViewSource::kLive);
}

void Workspace::SetViewSource(ViewSource source) {
  if (source == view_source_) {
    return;
  }
  view_source_ = source;
  picture_ = nullptr;
  preview_ = nullptr;
  preview_key_.clear();
  preview_stale_ = true;
}

int64_t Workspace::frame() const {
  const std::optional<PreviewSource> source = recording();
  if (!source || source->frames <= 0) {
    return 0;
  }
  const double frames = time_ * source->frames_per_second;
  return static_cast<int64_t>(frames + kSameFrame) % source->frames;
}

void Workspace::SetFrame(int64_t frame) {
  if (const std::optional<PreviewSource> source = recording()) {
    const int64_t last = std::max<int64_t>(source->frames - 1, 0);
    SetTime(static_cast<double>(std::clamp<int64_t>(frame, 0, last)) / source->frames_per_second);
  }
}

void Workspace::StepFrames(int64_t frames) {
  const std::optional<PreviewSource> source = recording();
  if (source && !source->live) {
    SetTime(TimeOfStep(time_, frames, source->frames_per_second, duration()));
  }
}

void Workspace::SetTime(double seconds) {
  time_ = std::isfinite(seconds) ? std::clamp(seconds, 0.0, drama::Drama::kMaxTime) : 0.0;
}

double Workspace::duration() const {
  double duration = script_.duration();
  if (const std::optional<PreviewSource> source = recording(); source && source->frames > 0) {
    duration = std::max(duration, static_cast<double>(source->frames) / source->frames_per_second);
  }
  return std::max(duration, drama_run_ != nullptr ? drama_run_->last : 0.0);
}

void Workspace::AdvancePlayback(double seconds) {
  const double end = duration();
  if (!playing_ || end <= 0.0) {
    return;
  }
  time_ = time_ + seconds < end ? time_ + seconds : 0.0;
}

size_t Workspace::PeopleLeft() const {
  const std::vector<CastDocument>& cast = document().cast;
  return static_cast<size_t>(std::count_if(
      cast.begin(), cast.end(),
      [this](const CastDocument& member) { return cast_pictures_.Working(member.name); }));
}

bool Workspace::StageIsOutdated() const {
  return preview_stale_ || (stand_ins_ == 0 && cast_pictures_.Working()) ||
         tasks_.Running(TaskKind::kOpening);
}

void Workspace::RequestPicture() {
  if (preview_ == nullptr || loaded_.staged == nullptr || place() == nullptr) {
    return;
  }
  if (!recording()) {
    // The frame is not known before the recording is open.
    awaiting_picture_ = !preview_->failed();
    return;
  }
  constexpr double kSettled = 0.4;  // Seconds without edits.
  PreviewRequest request;
  request.settled = since_edit_ >= kSettled;
  request.frame = frame();
  request.sound = playing_ && sound_;
  request.time = time_;
  request.onion = playing_ ? std::nullopt : onion_;
  // The new script needs the new stage, so the request keeps the old one until the stage is ready.
  const bool wait = StageIsOutdated() && requested_text_ != nullptr;
  const int64_t revision = wait ? requested_script_ : script_.revision();
  request.script = wait ? requested_text_ : script_.snapshot();
  if (place_changed_) {
    auto staged = std::make_shared<stage::Place>(*loaded_.staged);
    const PlaceDocument& at = *place();
    staged->map_from_stage = loaded_.picks.map_from_picked * at.picked_from_stage;
    staged->camera_nudge = at.camera_nudge;
    staged->acoustics = at.acoustics;
    staged->camera = camera_look_ ? at.camera : std::nullopt;
    staged->probes = RelitProbes(loaded_.baked_light, loaded_.baked_probes, at.probes);
    for (stage::Occluder& occluder : staged->occluders) {
      if (const OccluderDocument* known = at.FindOccluder(occluder.name)) {
        Restage(*known, staged->map_from_stage, occluder);
      }
    }
    loaded_.staged = staged;
  } else if (request.frame == requested_frame_ && request.time == requested_time_ &&
             revision == requested_script_ && request.sound == requested_sound_ &&
             request.onion.has_value() == requested_onion_ &&
             request.settled == requested_settled_) {
    return;
  }
  request.place = loaded_.staged;
  for (const ObjectDocument& object : document().objects) {
    request.objects.push_back({object.name, InitialPose(object)});
  }
  request.compare = compare_;
  request.evidence = evidence_;
  request.descriptions = descriptions_;
  place_changed_ = false;
  requested_frame_ = request.frame;
  requested_sound_ = request.sound;
  requested_onion_ = request.onion.has_value();
  requested_settled_ = request.settled;
  requested_time_ = request.time;
  requested_script_ = revision;
  requested_text_ = request.script;
  awaiting_picture_ = true;
  preview_->Request(std::move(request));
}

void Workspace::Update(double seconds) {
  tasks_.Poll();
  if (unsaved_map_ && !tasks_.Running(TaskKind::kWritingMap) &&
      !tasks_.Running(TaskKind::kTraining)) {
    WriteMap();
  }
  if (map_stale_) {
    ReloadMap();
  }
  // Other programs can edit the files.
  constexpr double kFilesInterval = 1.0;
  since_files_checked_ += seconds;
  if (since_files_checked_ > kFilesInterval) {
    since_files_checked_ = 0.0;
    AskForPictures();
    preview_stale_ = true;
    DetectExternalChanges();
    // Another program trained the place.
    map_stale_ |= loaded_.database != nullptr && !tasks_.Running(TaskKind::kTraining) &&
                  !tasks_.Running(TaskKind::kOpening) && !tasks_.Running(TaskKind::kWritingMap) &&
                  !unsaved_map_ && FileStamp(paths_.Scene(place_name_)) != scene_stamp_;
  }
  since_script_ += seconds;
  since_lines_ += seconds;
  since_edit_ += seconds;
  constexpr double kPauseAfterLines = 0.8;  // Seconds; longer than a pause while typing.
  if (since_lines_ > kPauseAfterLines) {
    WriteLines();
  }
  if (preview_ != nullptr && preview_->failed() && previewed_script_ != script_.revision()) {
    preview_key_.clear();  // The script may be the cause of the failure.
    preview_stale_ = true;
  }
  RunDramaAgain();
  if (measures_stale_) {
    MeasureAgain();
  }
  TellOfPictures();
  const size_t left = PeopleLeft();
  if (left < stand_ins_) {
    preview_key_.clear();
    preview_stale_ = true;
  }
  // A person who was edited is baked for the portrait first, and the stage follows. Without a
  // preview, replacements are shown.
  if (preview_stale_ && (left == 0 || preview_ == nullptr || stand_ins_ > 0)) {
    ReloadPreview();
  }
  AdvancePlayback(seconds);
  RequestPicture();
  if (preview_ == nullptr) {
    awaiting_picture_ = false;
    return;
  }
  if (auto picture = preview_->TakePicture()) {
    picture_ = std::move(*picture);
    told_of_preview_.clear();
    awaiting_picture_ = picture_->frame != requested_frame_ || picture_->time != requested_time_;
  }
  if (view_source_ == ViewSource::kLive && preview_->failed()) {
    for (const Status& problem : preview_->TakeProblems()) {
      Tell(Message::Level::kError, problem.message());
    }
    SetViewSource(ViewSource::kRecording);
    return;
  }
  const std::vector<Status> problems = preview_->TakeProblems();
  if (StageIsOutdated()) {
    return;
  }
  for (const Status& problem : problems) {
    awaiting_picture_ = false;
    // A problem that prevents every picture occurs again with each reading, so it is reported only
    // once.
    if (told_of_preview_.insert(problem.message()).second) {
      Tell(Message::Level::kError, problem.message());
    }
  }
}

void Workspace::SetCameraLook(bool on) {
  place_changed_ |= on != camera_look_;
  camera_look_ = on;
}

void Workspace::SetOnionSkin(const std::optional<OnionSkin>& onion) {
  place_changed_ |= onion != onion_;
  onion_ = onion;
}

void Workspace::SetEvidence(bool on) {
  place_changed_ |= on != evidence_;
  evidence_ = on;
}

void Workspace::SetDescriptions(bool on) {
  place_changed_ |= on != descriptions_;
  descriptions_ = on;
}

void Workspace::SetCompare(bool compare) {
  place_changed_ |= compare && !compare_;
  compare_ = compare;
}

}  // namespace lararium::editor
