#include "editor/session/preview_session.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "editor/document/file_stamp.h"
#include "editor/import/objects/object_import.h"
#include "editor/jobs/baking.h"
#include "editor/jobs/drawn_occluder.h"
#include "editor/jobs/filming.h"
#include "editor/jobs/object_pose.h"
#include "editor/jobs/sounds.h"
#include "editor/jobs/staging.h"
#include "editor/text/text.h"

namespace lararium::editor {

PreviewSession::PreviewSession(ProjectSession& project,
                               const MapSession& map,
                               const CastSession& cast,
                               Playback& playback,
                               TaskList& tasks,
                               MessageLog& messages,
                               Log& log,
                               std::shared_ptr<std::mutex> baking)
    : project_(project),
      map_(map),
      cast_(cast),
      playback_(playback),
      tasks_(tasks),
      messages_(messages),
      log_(log),
      baking_(std::move(baking)) {
  project_.Subscribe([this](ProjectSession::Event event) {
    switch (event) {
      case ProjectSession::Event::kEdited:
        since_edit_ = 0.0;
        place_changed_ = true;
        stale_ = true;
        break;
      case ProjectSession::Event::kPlaceSelected:
        Close();
        staged_ = nullptr;
        view_source_ = ViewSource::kRecording;
        break;
      case ProjectSession::Event::kFilesChanged:
        stale_ = true;
        break;
    }
  });
}

std::string PreviewSession::Key() const {
  // Without drafts, because each new corner would open the preview again.
  const PlaceDocument at = WithoutDrafts(*project_.place(), *map_.loaded().database);
  const ProjectPaths& paths = project_.paths();
  const ProjectDocument& document = project_.document();
  Json key = {{"place", at.name},
              {"map", map_.loads()},
              {"training", at.training.path},
              {"preview", {static_cast<int>(at.preview.kind), at.preview.path}},
              {"view", {static_cast<int>(view_source_), live_camera_}},
              {"languages", {document.speech.spoken, document.speech.captions}}};
  for (const char* file : {"lines.csv", "lines.json", "paradata.json"}) {
    key["texts"].push_back(FileStamp(paths.folder / file));
  }
  for (const SoundFile& sound : FindSounds(paths)) {
    key["sounds"].push_back({sound.name, FileStamp(sound.file)});
  }
  for (const OccluderDocument& occluder : at.occluders) {
    // Sizes and effects of a shape can change without opening the preview again.
    Json& entry = key["occluders"].emplace_back(
        Json::array({occluder.name, occluder.file, occluder.shape.has_value()}));
    if (occluder.drawn()) {
      // The depth is in metres, the map is not.
      const double scale = map_.loaded().picks.map_from_picked.scale * at.picked_from_stage.scale;
      entry.push_back({FormatFields(occluder)["corners"], occluder.depth * scale, occluder.flat});
    }
  }
  for (const ProbeDocument& probe : at.probes) {
    // Rotation and brightness can change without opening the preview again.
    key["probes"].push_back({probe.name, probe.file, FileStamp(paths.Resolve(probe.file))});
  }
  for (CastDocument member : document.cast) {
    member.title.clear();  // A title changes no picture.
    key["cast"].push_back(FormatFields(member));
  }
  for (const ObjectDocument& object : document.objects) {
    // The pose can change without opening the preview again.
    const Result<std::filesystem::path> file = ObjectFile(paths, object);
    key["objects"].push_back({object.name, object.model, object.file,
                              file.ok() ? FileStamp(*file) : "",
                              file.ok() ? FileStamp(import::UseFileBeside(*file)) : ""});
  }
  return key.dump();
}

void PreviewSession::Open() {
  stale_ = false;
  if (project_.place() == nullptr || map_.loaded().database == nullptr) {
    return;
  }
  std::string key = Key();
  if (key == key_) {
    return;
  }
  const auto content = std::make_shared<show::ShowContent>();
  const auto report = std::make_shared<BakeReport>();
  const auto missing = std::make_shared<size_t>(0);  // Number of people with a replacement.
  const auto work = [content, report, missing, others_stand_in = cast_.pictures().PeopleLeft() > 0,
                     paths = project_.paths(), document = project_.commands().snapshot(),
                     script = project_.script().snapshot(), name = project_.place_name(),
                     database = map_.loaded().database, baking = baking_,
                     map_from_picked = map_.loaded().picks.map_from_picked](Progress& progress) {
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
  const auto done = [this, content, report, missing, revision = project_.script().revision(),
                     document = project_.commands().snapshot(),
                     name = project_.place_name()](const Status& status, bool cancelled) {
    stand_ins_ = *missing;
    if (!status.ok()) {
      messages_.Report(status, cancelled, "");
      return;
    }
    for (const std::string& warning : report->warnings) {
      messages_.Warn(warning);
    }
    if (name != project_.place_name() || project_.place() == nullptr) {
      stale_ = true;
      return;
    }
    staged_ = std::make_shared<const stage::Place>(content->places.front().stage);
    baked_probes_ = document->FindPlace(name)->probes;
    baked_light_ = staged_->probes;
    preview_ = std::make_unique<Preview>(ViewOpener(), std::move(*content), log_);
    opened_script_ = revision;
    place_changed_ = true;
    project_.NoteFilesChanged();  // Products were baked.
  };
  if (tasks_.Start(TaskKind::kOpening, work, done)) {
    key_ = std::move(key);
  } else {
    stale_ = true;  // Try again after the running task.
  }
}

bool PreviewSession::has_own_recording() const {
  const PlaceDocument* place = project_.place();
  const ProjectPaths& paths = project_.paths();
  return place != nullptr && !place->preview.empty() &&
         (place->preview.kind != place->training.kind ||
          paths.Resolve(place->preview.path) != paths.Resolve(place->training.path));
}

Preview::Opener PreviewSession::ViewOpener() {
  if (view_source_ == ViewSource::kLive) {
    camera_presence_ = std::make_shared<CameraPresence>(true);
    return [camera = live_camera_, presence = camera_presence_] {
      return OpenLiveCamera(camera, presence);
    };
  }
  const bool training = view_source_ == ViewSource::kTraining || !has_own_recording();
  return [paths = project_.paths(),
          source = training ? project_.place()->training : project_.place()->preview] {
    return OpenSource(paths, source);
  };
}

SourceDocument PreviewSession::FirstRecording() const {
  const PlaceDocument* place = project_.place();
  if (place == nullptr || view_source_ == ViewSource::kLive) {
    return {};
  }
  return has_own_recording() ? place->preview : place->training;
}

Result<PreviewSession::FirstLook> PreviewSession::LookAt(const ProjectPaths& paths,
                                                         const SourceDocument& recording) {
  constexpr double kWidest = 960.0;
  LARARIUM_ASSIGN_OR_RETURN(const std::unique_ptr<capture::FrameSource> source,
                            OpenSource(paths, recording));
  LARARIUM_ASSIGN_OR_RETURN(const std::optional<geometry::Frame> frame, source->Next());
  if (!frame) {
    return Status::Error(recording.path, "has no images");
  }
  const double scale = std::min(1.0, kWidest / frame->bgr.cols);
  FirstLook look{{}, source->Notes()};
  cv::resize(frame->bgr, look.image, cv::Size(), scale, scale, cv::INTER_AREA);
  return look;
}

std::shared_ptr<const cv::Mat> PreviewSession::first_image() const {
  const FirstLook* look = first_look_.Find(FirstRecording().path);
  return look == nullptr ? nullptr
                         : std::shared_ptr<const cv::Mat>(first_look_.newest(), &look->image);
}

std::vector<std::string> PreviewSession::recording_notes() const {
  const FirstLook* look = first_look_.Find(FirstRecording().path);
  return look == nullptr ? std::vector<std::string>() : look->notes;
}

void PreviewSession::ReadFirstImage() {
  const SourceDocument recording = FirstRecording();
  if (!recording.empty()) {
    first_look_.Refresh(
        recording.path, TaskKind::kFirstImage, tasks_,
        [paths = project_.paths(), recording](Progress&) { return LookAt(paths, recording); });
  }
}

void PreviewSession::PreviewLiveCamera(const std::string& camera) {
  SetViewSource(ViewSource::kRecording);
  live_camera_ = IsCameraNumber(camera) ? camera : project_.paths().Resolve(camera).string();
  SetViewSource(ViewSource::kLive);
}

void PreviewSession::SetViewSource(ViewSource source) {
  if (source == view_source_) {
    return;
  }
  view_source_ = source;
  Close();
  stale_ = true;
}

void PreviewSession::Close() {
  picture_ = nullptr;
  preview_ = nullptr;
  key_.clear();
  playback_.SetRecording(std::nullopt);
}

void PreviewSession::Reopen() {
  key_.clear();
  stale_ = true;
}

bool PreviewSession::StageIsOutdated() const {
  return stale_ || (stand_ins_ == 0 && cast_.pictures().PeopleLeft() > 0) ||
         tasks_.Running(TaskKind::kOpening);
}

void PreviewSession::Restage() {
  auto staged = std::make_shared<stage::Place>(*staged_);
  const PlaceDocument& at = *project_.place();
  staged->map_from_stage = map_.loaded().picks.map_from_picked * at.picked_from_stage;
  staged->camera_nudge = at.camera_nudge;
  staged->acoustics = at.acoustics;
  staged->camera = look_.camera_traits ? at.camera : std::nullopt;
  staged->probes = RelitProbes(baked_light_, baked_probes_, at.probes);
  for (stage::Occluder& occluder : staged->occluders) {
    if (const OccluderDocument* known = at.FindOccluder(occluder.name)) {
      editor::Restage(*known, staged->map_from_stage, occluder);
    }
  }
  staged_ = std::move(staged);
  place_changed_ = false;
}

void PreviewSession::Request() {
  if (preview_ == nullptr || staged_ == nullptr || project_.place() == nullptr) {
    return;
  }
  if (!playback_.recording()) {
    // The frame is not known before the recording is open.
    awaiting_picture_ = !preview_->failed();
    return;
  }
  constexpr double kSettled = 0.4;  // Seconds without edits.
  // The new script needs the new stage, so the request keeps the old one until the stage is ready.
  const bool wait = StageIsOutdated() && asked_text_ != nullptr;
  const bool playing = playback_.playing();
  Asked asked = {.frame = playback_.frame(),
                 .time = playback_.time(),
                 .sound = playing && playback_.sound(),
                 .settled = since_edit_ >= kSettled,
                 .script = wait ? asked_.script : project_.script().revision(),
                 .look = look_};
  asked.look.onion = playing ? std::nullopt : look_.onion;
  if (asked == asked_ && !place_changed_) {
    return;
  }
  if (place_changed_ || look_.camera_traits != asked_.look.camera_traits) {
    Restage();
  }
  asked_ = asked;
  asked_text_ = wait ? asked_text_ : project_.script().snapshot();
  PreviewRequest request{.frame = asked.frame,
                         .time = asked.time,
                         .script = asked_text_,
                         .place = staged_,
                         .objects = {},
                         .settled = asked.settled,
                         .compare = asked.look.compare,
                         .onion = asked.look.onion,
                         .evidence = asked.look.evidence,
                         .descriptions = asked.look.descriptions,
                         .sound = asked.sound};
  for (const ObjectDocument& object : project_.document().objects) {
    request.objects.push_back({object.name, InitialPose(object)});
  }
  awaiting_picture_ = true;
  preview_->Request(std::move(request));
}

void PreviewSession::Collect() {
  if (auto picture = preview_->TakePicture()) {
    picture_ = std::move(*picture);
    told_.clear();
    awaiting_picture_ = picture_->frame != asked_.frame || picture_->time != asked_.time;
  }
  const std::vector<Status> problems = preview_->TakeProblems();
  if (view_source_ == ViewSource::kLive && preview_->failed()) {
    for (const Status& problem : problems) {
      messages_.TellFailure(problem);
    }
    SetViewSource(ViewSource::kRecording);
    return;
  }
  if (StageIsOutdated()) {
    return;
  }
  for (const Status& problem : problems) {
    awaiting_picture_ = false;
    // A problem that prevents every picture occurs again with each reading, so it is reported only
    // once.
    if (told_.insert(problem.message()).second) {
      messages_.TellFailure(problem);
    }
  }
}

void PreviewSession::Update(double seconds) {
  since_edit_ += seconds;
  if (map_revision_ != map_.revision()) {
    map_revision_ = map_.revision();
    place_changed_ = true;
    stale_ = true;
  }
  const size_t left = cast_.pictures().PeopleLeft();
  // The script may be the cause of a failure, and a person who was drawn as a replacement is ready.
  if ((preview_ != nullptr && preview_->failed() &&
       opened_script_ != project_.script().revision()) ||
      left < stand_ins_) {
    Reopen();
  }
  // A person who was edited is baked for the portrait first, and the stage follows. Without a
  // preview, replacements are shown.
  if (stale_ && (left == 0 || preview_ == nullptr || stand_ins_ > 0)) {
    Open();
  }
  playback_.SetRecording(preview_ != nullptr ? preview_->source() : std::nullopt);
  Request();
  if (preview_ == nullptr) {
    awaiting_picture_ = false;
  } else {
    Collect();
  }
  ReadFirstImage();
}

FrameToPick PreviewSession::frame_to_pick() const {
  if (picture_ == nullptr || map_.loaded().database == nullptr) {
    return {std::nullopt, TrLater("There is no picture yet")};
  }
  if (view_source_ == ViewSource::kLive) {
    return {std::nullopt, TrLater("A live camera's images pass: pick in the training recording")};
  }
  if (picture_->frame != playback_.frame()) {
    return {std::nullopt, TrLater("The picture of this frame is on its way")};
  }
  if (tasks_.Running(TaskKind::kTraining)) {
    return {std::nullopt, TrLater("The place is being trained: pick when that is done")};
  }
  return FindFrameToPick(*picture_, *map_.loaded().database,
                         view_source_ == ViewSource::kTraining || !has_own_recording());
}

}  // namespace lararium::editor
