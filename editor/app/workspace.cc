#include "editor/app/workspace.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "editor/app/baking.h"
#include "editor/app/camera_measure.h"
#include "editor/app/exporting.h"
#include "editor/app/sounds.h"
#include "editor/app/training.h"

namespace lararium::app {

namespace {

constexpr size_t kMaxMessages = 200;

// Modification time as text; changes when the file does.
std::string FileStamp(const std::filesystem::path& file) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file, error);
  return error ? "none" : std::to_string(time.time_since_epoch().count());
}

// Where people made from the presets are kept (XDG base directories).
std::filesystem::path PresetFolder() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  const std::filesystem::path base =
      cache != nullptr && *cache != '\0'
          ? std::filesystem::path(cache)
          : std::filesystem::path(home != nullptr ? home : ".") / ".cache";
  return base / "lararium" / "presets";
}

std::string TagsKey(const PlaceDocument& place) {
  return place.tags ? place.tags->family + " " + std::to_string(place.tags->size_m) : "";
}

}  // namespace

Result<std::unique_ptr<Workspace>> Workspace::Open(ProjectPaths paths, Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  std::unique_ptr<Workspace> workspace(new Workspace(std::move(paths), std::move(document), log));
  Result<std::optional<ProjectDocument>> left = LoadAutosave(workspace->paths_);
  if (!left) {
    workspace->Tell(Message::Level::kWarning,
                    left.message() + "; it was left as it is, move it away to stop this message");
  } else if (left->has_value()) {
    workspace->Edit("recover", [&](ProjectDocument& current) { current = std::move(**left); });
    workspace->Tell(Message::Level::kWarning,
                    "Edits that were not saved have been recovered. Undo takes them back.");
  }
  for (const Status& missing : FindMissingFiles(workspace->paths_, workspace->document())) {
    workspace->Tell(Message::Level::kWarning, missing.message());
  }
  if (!workspace->document().places.empty()) {
    workspace->ShowPlace(workspace->document().places.front().name);
  }
  workspace->cast_pictures_.SetCast(workspace->document().cast);
  return workspace;
}

Workspace::Workspace(ProjectPaths paths, ProjectDocument document, Log& log)
    : paths_(std::move(paths)),
      log_(log),
      commands_(std::move(document)),
      autosave_(paths_),
      cast_pictures_(paths_, PresetFolder(), baking_) {}

void Workspace::Tell(Message::Level level, std::string text) {
  if (!messages_.empty() && messages_.back().text == text) {
    return;  // said already
  }
  messages_.push_back({level, std::move(text)});
  if (messages_.size() > kMaxMessages) {
    messages_.pop_front();
  }
}

void Workspace::Report(const Status& status, bool cancelled, const std::string& success) {
  if (cancelled) {
    Tell(Message::Level::kInfo, "Cancelled. Nothing was changed.");
  } else if (!status.ok()) {
    Tell(Message::Level::kError, status.message());
  } else {
    Tell(Message::Level::kInfo, success);
  }
}

void Workspace::ShowPlace(const std::string& name) {
  place_name_ = name;
  loaded_ = {};
  picture_ = nullptr;
  preview_ = nullptr;
  position_ = 0.0;
  playing_ = false;
  map_stale_ = true;
}

void Workspace::Edit(const std::string& name,
                     const std::function<void(ProjectDocument&)>& change,
                     std::string_view gesture) {
  commands_.Edit(name, change, gesture);
  OnDocumentChanged();
}

void Workspace::EditPlace(const std::string& name,
                          const std::function<void(PlaceDocument&)>& change,
                          std::string_view gesture) {
  Edit(
      name,
      [&](ProjectDocument& document) {
        if (PlaceDocument* place = document.FindPlace(place_name_)) {
          change(*place);
        }
      },
      gesture);
}

void Workspace::Undo() {
  if (commands_.CanUndo()) {
    commands_.Undo();
    OnDocumentChanged();
  }
}

void Workspace::Redo() {
  if (commands_.CanRedo()) {
    commands_.Redo();
    OnDocumentChanged();
  }
}

void Workspace::Save() {
  if (const Status status = SaveProject(paths_, document()); !status.ok()) {
    Tell(Message::Level::kError, status.message());
    return;
  }
  commands_.MarkSaved();
  autosave_.Discard();
  Tell(Message::Level::kInfo, "Saved " + paths_.Project().string());
}

void Workspace::OnDocumentChanged() {
  if (commands_.dirty()) {
    autosave_.Write(commands_.snapshot());
  } else {
    autosave_.Discard();
  }
  cast_pictures_.SetCast(document().cast);
  if (place() == nullptr && !document().places.empty()) {
    ShowPlace(document().places.front().name);  // undo took the place away
    return;
  }
  ResolvePicksAgain();
  place_changed_ = true;
  preview_stale_ = true;
}

void Workspace::ResolvePicksAgain() {
  if (place() == nullptr || loaded_.database == nullptr) {
    return;
  }
  measures_stale_ |= TagsKey(*place()) != tags_key_;
  const std::string key = FormatPicks(place()->picks).dump();
  if (key != picks_key_) {
    picks_key_ = key;
    loaded_.picks = ResolvePicks(*place(), *loaded_.database, loaded_.measures);
    if (!loaded_.picks.problem.ok()) {
      Tell(Message::Level::kWarning, loaded_.picks.problem.message());
    }
  }
}

void Workspace::MeasureAgain() {
  measures_stale_ = false;
  if (place() == nullptr || loaded_.database == nullptr) {
    return;
  }
  const auto measures = std::make_shared<MapMeasures>();
  const auto work = [measures, place = *place(), database = loaded_.database](Progress& progress) {
    progress.Report("looking for the floor and for tags", 0.0);
    *measures = MeasureMap(place, *database);
    return Status();
  };
  const auto done = [this, measures, database = loaded_.database](const Status&, bool cancelled) {
    if (!cancelled && database == loaded_.database) {
      loaded_.measures = std::move(*measures);
      loaded_.measured = true;
      picks_key_.clear();
      ResolvePicksAgain();
      place_changed_ = true;
    }
  };
  if (tasks_.Start(kMeasuring, work, done)) {
    tags_key_ = TagsKey(*place());
    loaded_.measured = false;
  } else {
    measures_stale_ = true;  // once the measuring at work has ended
  }
}

void Workspace::LayStageOnFloor() {
  if (!loaded_.measures.floor || place() == nullptr) {
    return;
  }
  const geometry::Similarity3& now = place()->picked_from_stage;
  const geometry::Similarity3 laid =
      LayOnFloor(loaded_.picks.map_from_picked, now, *loaded_.measures.floor);
  constexpr double kSame = 1e-7;  // metres, radians
  if ((laid.translation - now.translation).norm() > kSame ||
      laid.rotation.angularDistance(now.rotation) > kSame) {
    EditPlace("lay the stage on the floor",
              [&](PlaceDocument& edited) { edited.picked_from_stage = laid; });
  }
}

void Workspace::ReloadMap() {
  const std::filesystem::path file = paths_.Scene(place_name_);
  std::error_code ignored;
  if (place() == nullptr || !std::filesystem::exists(file, ignored)) {
    map_stale_ = false;
    return;
  }
  using Database = std::shared_ptr<const vision::SceneDatabase>;
  const auto loaded = std::make_shared<Database>();
  const auto measures = std::make_shared<MapMeasures>();
  const auto work = [=, place = *place()](Progress& progress) {
    progress.Report("reading the map", 0.0);
    LARARIUM_ASSIGN_OR_RETURN(vision::SceneDatabase database, vision::LoadSceneDatabase(file));
    progress.Report("looking for the floor and for tags", 0.5);
    *measures = MeasureMap(place, database);
    *loaded = std::make_shared<const vision::SceneDatabase>(std::move(database));
    return Status();
  };
  const auto done = [this, loaded, measures, name = place_name_, key = TagsKey(*place())](
                        const Status& status, bool cancelled) {
    if (!status.ok()) {
      Report(status, cancelled, "");
    } else if (name == place_name_) {
      loaded_.database = *loaded;
      loaded_.measures = std::move(*measures);
      loaded_.measured = true;
      tags_key_ = key;
      picks_key_.clear();
      ResolvePicksAgain();
      preview_key_.clear();
      preview_stale_ = true;
    }
  };
  // False while something else opens: Update() tries again.
  map_stale_ = !tasks_.Start(kOpening, work, done);
}

std::string Workspace::PreviewKey() const {
  const PlaceDocument& at = *place();
  Json key = {{"place", at.name},
              {"drama", FileStamp(paths_.Drama())},
              {"scene", FileStamp(paths_.Scene(at.name))},
              {"training", at.training.path},
              {"preview", at.preview.path}};
  for (const char* file : {"lines.csv", "lines.json", "paradata.json"}) {
    key["texts"].push_back(FileStamp(paths_.folder / file));
  }
  for (const SoundFile& sound : FindSounds(paths_)) {
    key["sounds"].push_back({sound.name, sound.built_in ? "" : FileStamp(sound.file)});
  }
  for (const OccluderDocument& occluder : at.occluders) {
    key["occluders"].push_back({occluder.name, occluder.file});
  }
  for (const ProbeDocument& probe : at.probes) {
    // How it lies and how bright it is changes without opening anew.
    key["probes"].push_back({probe.name, probe.file, FileStamp(paths_.Resolve(probe.file))});
  }
  for (const CastDocument& member : document().cast) {
    key["cast"].push_back(FormatCastMember(member));
  }
  for (const ObjectDocument& object : document().objects) {
    key["objects"].push_back(
        {FormatObject(object), object.file.empty() ? "" : FileStamp(paths_.Resolve(object.file))});
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
  const auto work = [content, report, paths = paths_, document = commands_.snapshot(),
                     name = place_name_, database = loaded_.database, baking = baking_,
                     map_from_picked = loaded_.picks.map_from_picked](Progress& progress) {
    {
      const std::lock_guard turn(*baking);
      LARARIUM_ASSIGN_OR_RETURN(*report, app::Bake(paths, *document, progress));
    }
    LARARIUM_ASSIGN_OR_RETURN(*content, AssembleShow(paths, *document, *document->FindPlace(name),
                                                     database, map_from_picked));
    return Status();
  };
  const auto done = [this, content, report, document = commands_.snapshot(), name = place_name_](
                        const Status& status, bool cancelled) {
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
    const SourceDocument& source = place()->preview.empty() ? place()->training : place()->preview;
    preview_ = std::make_unique<Preview>(paths_, source, std::move(*content), log_);
    requested_frame_ = -1;
    place_changed_ = true;
  };
  if (tasks_.Start(kOpening, work, done)) {
    preview_key_ = std::move(key);
  } else {
    preview_stale_ = true;  // once the task at work has ended
  }
}

void Workspace::SetFrame(int64_t frame) {
  const std::optional<PreviewSource> source = recording();
  const int64_t last = source ? std::max<int64_t>(source->frames - 1, 0) : 0;
  if (frame != this->frame() || frame > last) {
    position_ = static_cast<double>(std::clamp<int64_t>(frame, 0, last));
  }
}

void Workspace::AdvancePlayback(double seconds) {
  const std::optional<PreviewSource> source = recording();
  if (!playing_ || !source || source->frames <= 0) {
    return;
  }
  position_ = std::fmod(position_ + seconds * source->frames_per_second,
                        static_cast<double>(source->frames));
}

void Workspace::RequestPicture() {
  if (preview_ == nullptr || loaded_.staged == nullptr || place() == nullptr) {
    return;
  }
  PreviewRequest request;
  request.frame = frame();
  request.sound = playing_ && sound_;
  if (place_changed_) {
    auto staged = std::make_shared<stage::Place>(*loaded_.staged);
    const PlaceDocument& at = *place();
    staged->map_from_stage = loaded_.picks.map_from_picked * at.picked_from_stage;
    staged->camera_nudge = at.camera_nudge;
    staged->camera = camera_look_ ? at.camera : std::nullopt;
    staged->probes = RelitProbes(loaded_.baked_light, loaded_.baked_probes, at.probes);
    for (stage::Occluder& occluder : staged->occluders) {
      const auto known =
          std::find_if(at.occluders.begin(), at.occluders.end(),
                       [&](const OccluderDocument& o) { return o.name == occluder.name; });
      if (known != at.occluders.end()) {
        occluder.stage_from_mesh = known->stage_from_mesh;
      }
    }
    loaded_.staged = staged;
  } else if (request.frame == requested_frame_ && request.sound == requested_sound_) {
    return;
  }
  request.place = loaded_.staged;
  request.compare = compare_;
  request.evidence = evidence_;
  place_changed_ = false;
  requested_frame_ = request.frame;
  requested_sound_ = request.sound;
  awaiting_picture_ = true;
  preview_->Request(std::move(request));
}

void Workspace::Update(double seconds) {
  tasks_.Poll();
  if (const Status status = autosave_.TakeStatus(); !status.ok()) {
    Tell(Message::Level::kWarning, status.message());
  }
  if (map_stale_) {
    ReloadMap();
  }
  // The drama is edited outside of this window.
  constexpr double kFilesInterval = 1.0;
  since_files_checked_ += seconds;
  if (since_files_checked_ > kFilesInterval) {
    since_files_checked_ = 0.0;
    preview_stale_ = true;
    cast_pictures_.SetCast(document().cast);
  }
  if (measures_stale_) {
    MeasureAgain();
  }
  TellOfPictures();
  // Who is being changed is baked for their picture first; the stage follows.
  if (preview_stale_ && !cast_pictures_.Working()) {
    ReloadPreview();
  }
  AdvancePlayback(seconds);
  SetFrame(frame());  // the end may have turned out to be nearer
  RequestPicture();
  if (preview_ == nullptr) {
    awaiting_picture_ = false;
    return;
  }
  if (auto picture = preview_->TakePicture()) {
    picture_ = std::move(*picture);
    awaiting_picture_ = picture_->frame != requested_frame_;
  }
  for (const Status& problem : preview_->TakeProblems()) {
    Tell(Message::Level::kError, problem.message());
    awaiting_picture_ = false;
  }
}

void Workspace::TellOfPictures() {
  for (const std::string& warning : cast_pictures_.TakeWarnings()) {
    Tell(Message::Level::kWarning, warning);
  }
  for (const Status& problem : cast_pictures_.TakeProblems()) {
    Tell(Message::Level::kError, problem.message());
  }
}

const CastCatalogue* Workspace::catalogue() {
  if (catalogue_ != nullptr || !catalogue_problem_.empty()) {
    return catalogue_.get();
  }
  const std::optional<std::filesystem::path> folder = FindCastLibrary();
  if (!folder) {
    catalogue_problem_ =
        "The cast library is not installed; fetch it with scripts/fetch_cast_library.sh.";
    return nullptr;
  }
  const auto listed = std::make_shared<CastCatalogue>();
  tasks_.Start(
      kCatalogue,
      [listed, folder = *folder](Progress&) {
        LARARIUM_ASSIGN_OR_RETURN(const import::CastLibrary library,
                                  import::CastLibrary::Open(folder));
        LARARIUM_ASSIGN_OR_RETURN(*listed, ListCast(library));
        return Status();
      },
      [this, listed](const Status& status, bool) {
        if (status.ok()) {
          catalogue_ = listed;
        } else {
          catalogue_problem_ = status.message();
        }
      });
  return nullptr;
}

const BoneReview* Workspace::bone_review(const CastDocument& member) {
  std::string key = FormatCastMember(member).dump() + FileStamp(paths_.Resolve(member.model)) +
                    FileStamp(paths_.Resolve(member.bone_map));
  if (key != review_key_) {
    const auto review = std::make_shared<BoneReview>();
    const auto work = [review, paths = paths_, member](Progress&) {
      LARARIUM_ASSIGN_OR_RETURN(*review, ReviewBones(paths, member));
      return Status();
    };
    const auto done = [this, review, name = member.name](const Status& status, bool cancelled) {
      if (!status.ok()) {
        Report(status, cancelled, "");
        return;
      }
      review_ = review;
      reviewed_name_ = name;
    };
    if (tasks_.Start(kReview, work, done)) {
      review_key_ = std::move(key);
    }
  }
  return reviewed_name_ == member.name ? review_.get() : nullptr;
}

const ProbePicture* Workspace::probe_picture(const ProbeDocument& probe) {
  const std::filesystem::path file = paths_.Resolve(probe.file);
  std::string key = file.string() + FileStamp(file);
  if (key != probe_key_) {
    const auto picture = std::make_shared<ProbePicture>();
    const auto work = [picture, file](Progress&) {
      LARARIUM_ASSIGN_OR_RETURN(*picture, LoadProbePicture(file));
      return Status();
    };
    const auto done = [this, picture, key](const Status& status, bool) {
      if (status.ok()) {
        probe_picture_ = picture;
        pictured_probe_ = key;
      } else if (key == probe_key_) {
        probe_problem_ = status.message();
      }
    };
    if (tasks_.Start(kProbe, work, done)) {
      probe_problem_.clear();
      probe_key_ = key;
    }
  }
  return pictured_probe_ == key ? probe_picture_.get() : nullptr;
}

void Workspace::MeasureCameraTraits() {
  if (place() == nullptr) {
    return;
  }
  const auto traits = std::make_shared<light::CameraTraits>();
  tasks_.Start(
      kCamera,
      [traits, paths = paths_, place = *place()](Progress& progress) {
        LARARIUM_ASSIGN_OR_RETURN(*traits, MeasureCamera(paths, place, progress));
        return Status();
      },
      [this, traits, name = place_name_](const Status& status, bool cancelled) {
        Report(status, cancelled, name + ": " + CameraText(*traits));
        if (status.ok() && !cancelled) {
          Edit("measure the camera", [&](ProjectDocument& document) {
            if (PlaceDocument* place = document.FindPlace(name)) {
              place->camera = *traits;
            }
          });
        }
      });
}

void Workspace::SetCameraLook(bool on) {
  place_changed_ |= on != camera_look_;
  camera_look_ = on;
}

void Workspace::SetEvidence(bool on) {
  place_changed_ |= on != evidence_;
  evidence_ = on;
}

void Workspace::SetCompare(bool compare) {
  place_changed_ |= compare && !compare_;
  compare_ = compare;
}

void Workspace::SaveBones(const CastDocument& member) {
  if (review_ == nullptr || reviewed_name_ != member.name || tasks_.Running(kReview)) {
    return;  // what is known is not what is in use
  }
  if (const Status status = SaveBoneMap(paths_, member, *review_); !status.ok()) {
    Tell(Message::Level::kError, status.message());
    return;
  }
  const std::filesystem::path file = BoneMapFile(paths_, member);
  Edit("save the bones of " + member.name, [&](ProjectDocument& document) {
    for (CastDocument& known : document.cast) {
      if (known.name == member.name) {
        known.bone_map = paths_.Shorten(file);
        known.bones.clear();
      }
    }
  });
  Tell(Message::Level::kInfo, "Wrote " + file.string());
}

const train::TrainReport* Workspace::last_training() const {
  return trained_place_ == place_name_ ? training_.get() : nullptr;
}

void Workspace::StartTraining(std::function<Result<train::TrainReport>(Progress&)> work,
                              std::function<void()> done) {
  const auto report = std::make_shared<train::TrainReport>();
  const bool started = tasks_.Start(
      kTraining,
      [report, work = std::move(work)](Progress& progress) {
        LARARIUM_ASSIGN_OR_RETURN(*report, work(progress));
        return Status();
      },
      [this, report, name = place_name_, done = std::move(done)](const Status& status,
                                                                 bool cancelled) {
        Report(status, cancelled,
               name + ": " + std::to_string(report->located.size()) + " of " +
                   std::to_string(report->frames) + " images located, " +
                   std::to_string(report->points) + " points.");
        if (status.ok() && !cancelled) {
          training_ = report;
          trained_place_ = name;
          done();
        }
        map_stale_ |= status.ok() && name == place_name_;
      });
  if (!started) {
    Tell(Message::Level::kWarning, "A training is running already. Cancel it first.");
  }
}

void Workspace::Train() {
  if (place() == nullptr) {
    return;
  }
  StartTraining([paths = paths_, place = *place(), &log = log_](
                    Progress& progress) { return TrainPlace(paths, place, {}, progress, log); },
                [] {});
}

void Workspace::AddSession(const SessionDocument& session) {
  if (place() == nullptr) {
    return;
  }
  StartTraining(
      [paths = paths_, place = *place(), session, &log = log_](Progress& progress) {
        return TrainSession(paths, place, session, {}, progress, log);
      },
      [this, session, name = place_name_] {
        Edit("add a session", [&](ProjectDocument& document) {
          if (PlaceDocument* place = document.FindPlace(name)) {
            place->added.push_back(session);
          }
        });
      });
}

void Workspace::Bake() {
  const auto report = std::make_shared<BakeReport>();
  tasks_.Start(
      kBaking,
      [report, paths = paths_, document = commands_.snapshot(),
       baking = baking_](Progress& progress) {
        const std::lock_guard turn(*baking);
        LARARIUM_ASSIGN_OR_RETURN(*report, app::Bake(paths, *document, progress));
        return Status();
      },
      [this, report](const Status& status, bool cancelled) {
        for (const std::string& warning : report->warnings) {
          Tell(Message::Level::kWarning, warning);
        }
        Report(status, cancelled,
               "Baked " + std::to_string(report->baked.size()) + ", " +
                   std::to_string(report->unchanged.size()) + " were up to date.");
        preview_key_.clear();
        preview_stale_ = true;
      });
}

void Workspace::Export(const std::filesystem::path& out) {
  tasks_.Start(
      kExporting,
      [paths = paths_, document = commands_.snapshot(), out, baking = baking_](Progress& progress) {
        const std::lock_guard turn(*baking);
        return ExportProject(paths, *document, out, MapBudget(), progress);
      },
      [this, out](const Status& status, bool cancelled) {
        Report(status, cancelled, "Wrote " + out.string());
      });
}

}  // namespace lararium::app
