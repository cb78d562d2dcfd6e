#include "editor/app/workspace.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "editor/app/baking.h"
#include "editor/app/camera_measure.h"
#include "editor/app/drawn_occluder.h"
#include "editor/app/exporting.h"
#include "editor/app/filming.h"
#include "editor/app/former_map.h"
#include "editor/app/object_pose.h"
#include "editor/app/occluder_alignment.h"
#include "editor/app/player_trial.h"
#include "editor/app/sounds.h"
#include "editor/app/subcommands.h"
#include "editor/app/training.h"
#include "editor/app/user_folders.h"
#include "shared/core/file.h"

namespace lararium::app {

namespace {

constexpr size_t kMaxMessages = 200;
constexpr double kSameFrame = 1e-6;  // frames: what rounding leaves of a frame's own moment

// Changes when the file does: its time alone stands still for a few milliseconds at a time, but
// whoever writes a file anew gives it another number.
std::string FileStamp(const std::filesystem::path& file) {
  struct ::stat found = {};
  if (::stat(file.c_str(), &found) != 0) {
    return "none";
  }
  return std::to_string(found.st_mtim.tv_sec) + '.' + std::to_string(found.st_mtim.tv_nsec) + ' ' +
         std::to_string(found.st_size) + ' ' + std::to_string(found.st_ino);
}

// What is known of a training; nullptr where that is nothing, or the file is damaged: it is of no
// use to the map.
std::shared_ptr<const TrainingReport> ReadReport(const std::filesystem::path& file) {
  Result<TrainingReport> report = LoadTrainingReport(file);
  const bool known = report.ok() && !report->recording.empty();
  return known ? std::make_shared<const TrainingReport>(*std::move(report)) : nullptr;
}

std::string TagsKey(const PlaceDocument& place) {
  return place.tags ? place.tags->family + " " + std::to_string(place.tags->size_m) : "";
}

}  // namespace

Result<std::unique_ptr<Workspace>> Workspace::Open(ProjectPaths paths, Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  // A project without its drama opens: the missing file is told, and saving makes it.
  std::error_code ignored;
  std::string script;
  if (std::filesystem::exists(paths.Drama(), ignored)) {
    LARARIUM_ASSIGN_OR_RETURN(script, ReadText(paths.Drama(), drama::TimelineText::kMaxBytes));
  }
  Result<bake::LineTable> lines = bake::LoadLines(paths.folder);
  if (lines.ok()) {
    document.lines = std::make_shared<const bake::LineTable>(*std::move(lines));
  }
  std::unique_ptr<Workspace> workspace(
      new Workspace(std::move(paths), std::move(document), std::move(script), log));
  if (!lines.ok()) {
    workspace->Tell(Message::Level::kError, lines.message());
  }
  workspace->Recover();
  for (const Status& missing : FindMissingFiles(workspace->paths_, workspace->document())) {
    workspace->Tell(Message::Level::kWarning, missing.message());
  }
  if (!workspace->document().places.empty()) {
    workspace->ShowPlace(workspace->document().places.front().name);
  }
  workspace->AskForPictures();
  return workspace;
}

Workspace::Workspace(ProjectPaths paths, ProjectDocument document, std::string script, Log& log)
    : paths_(std::move(paths)),
      log_(log),
      commands_(std::move(document)),
      script_(std::move(script), paths_.Drama().filename().string()),
      saved_script_(script_.snapshot()),
      saved_project_(commands_.snapshot()),
      journal_(paths_.Journal(), commands_.document(), script_.snapshot()),
      script_stamp_(FileStamp(paths_.Drama())),
      project_stamp_(FileStamp(paths_.Project())),
      lines_stamp_(LinesStamp()),
      written_lines_(commands_.document().lines),
      cast_pictures_(paths_, CacheFolder() / "presets", baking_) {}

Workspace::~Workspace() {
  WriteLines();
  tasks_ = TaskList();  // waits for what is being written
  if (unsaved_map_ && FileStamp(unsaved_map_->file) == unsaved_map_->stamp) {
    const Status status = vision::SaveSceneDatabase(unsaved_map_->file, *unsaved_map_->database);
    if (!status.ok()) {
      log_.error("{}", status.message());
    }
  }
}

void Workspace::Recover() {
  Result<std::optional<JournalContent>> left =
      LoadJournal(paths_.Journal(), document().lines.get());
  if (!left.ok()) {
    const std::filesystem::path aside = paths_.folder / "journal.damaged";
    std::error_code error;
    std::filesystem::rename(paths_.Journal(), aside, error);
    Tell(Message::Level::kWarning,
         Text(Tr("%s; it was moved to %s and the project opened as saved"), left.message().c_str(),
              aside.c_str()));
    return;
  }
  if (!left->has_value() || (*left)->edits == 0) {
    journal_.Discard(document(), script_.snapshot());
    return;
  }
  TakeOver(std::move(**left));
}

void Workspace::TakeOver(JournalContent content) {
  const std::shared_ptr<const bake::LineTable> in_file = document().lines;
  std::shared_ptr<const bake::LineTable>& lines = content.project.lines;
  const bool lines_are_theirs = lines != nullptr && !content.lines_are_ours;
  if (lines == nullptr || (in_file != nullptr && *lines == *in_file)) {
    lines = in_file;
  }
  if (lines == in_file && content.script == script_.text() &&
      FormatProject(content.project) == FormatProject(document())) {
    journal_.Discard(document(), script_.snapshot());  // all of it reached its files
    return;
  }
  // In the journal first: it is never without what it held.
  Note(journal_.Restart(content.project, std::make_shared<const std::string>(content.script)));
  drama::TextEdit edit = script_.Replace(std::move(content.script));
  const size_t bytes = edit.removed.size() + edit.inserted.size();
  commands_.Edit(
      Tr("recover"), [&](ProjectDocument& current) { current = std::move(content.project); },
      "recover");
  commands_.EditPatched(Tr("recover"), std::move(edit), bytes, "recover");
  commands_.EndGesture();
  OnDocumentChanged();
  OnScriptChanged();
  Tell(Message::Level::kWarning,
       content.torn ? Tr("Edits that were not saved have been recovered, without the "
                         "last one. Undo takes them back.")
                    : Tr("Edits that were not saved have been recovered. Undo "
                         "takes them back."));
  if (lines_are_theirs) {  // as if it had happened just now
    Edit(Tr("take over the lines"), [&](ProjectDocument& current) { current.lines = in_file; });
    if (in_file != nullptr) {
      Tell(Message::Level::kInfo,
           Tr("The lines were changed outside of this window and are read again."));
    }
  }
}

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
    Tell(Message::Level::kInfo, Tr("Cancelled. Nothing was changed."));
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
  preview_key_.clear();
  playing_ = false;
  view_source_ = ViewSource::kRecording;
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

void Workspace::EditOccluder(const std::string& name,
                             const std::string& occluder,
                             const std::function<void(OccluderDocument&)>& change,
                             std::string_view gesture) {
  EditPlace(
      name,
      [&](PlaceDocument& place) {
        if (OccluderDocument* edited = place.FindOccluder(occluder)) {
          change(*edited);
        }
      },
      gesture);
}

bool Workspace::EditTimeline(const std::string& name,
                             const std::function<Status(drama::TimelineText&)>& change,
                             std::string_view gesture) {
  Result<drama::TextEdit> edit = script_.Change(change);
  if (!edit.ok()) {
    Tell(Message::Level::kError, edit.message());
    return false;
  }
  NoteScriptEdit(name, *std::move(edit), gesture);
  return true;
}

void Workspace::EditScript(const std::string& name, std::string text, std::string_view gesture) {
  NoteScriptEdit(name, script_.Replace(std::move(text)), gesture);
}

void Workspace::EditLines(const std::string& name,
                          bake::LineTable table,
                          std::string_view gesture) {
  // As journal and file have it: what could not be read back is no edit.
  const auto read_back = bake::ParseLinesCsv(bake::FormatLinesCsv(table), "the lines");
  if (!read_back.ok()) {
    Tell(Message::Level::kError, read_back.message());
    return;
  }
  auto next = std::make_shared<const bake::LineTable>(std::move(table));
  Edit(
      name, [&](ProjectDocument& document) { document.lines = next; }, gesture);
}

std::string Workspace::LinesStamp() const {
  return FileStamp(paths_.folder / "lines.csv") + FileStamp(paths_.folder / "lines.json");
}

std::shared_ptr<const bake::LineTable> Workspace::ReadLines() {
  lines_stamp_ = LinesStamp();
  Result<bake::LineTable> table = bake::LoadLines(paths_.folder);
  if (!table.ok()) {
    Tell(Message::Level::kError, table.message());
    return nullptr;
  }
  return std::make_shared<const bake::LineTable>(*std::move(table));
}

void Workspace::WriteLines() {
  if (document().lines == written_lines_ || document().lines == nullptr) {
    return;
  }
  if (LinesStamp() != lines_stamp_) {
    return;  // others have written it meanwhile: LookOutside() takes that over first
  }
  if (const Status status = bake::SaveLines(paths_.folder, *document().lines); !status.ok()) {
    Tell(Message::Level::kError, status.message());
    since_lines_ = 0.0;  // not with every frame
    return;
  }
  written_lines_ = document().lines;
  lines_stamp_ = LinesStamp();
  preview_stale_ = true;
  stage_changed_ = true;
  DiscardIfSaved();
}

void Workspace::NoteScriptEdit(const std::string& name,
                               drama::TextEdit edit,
                               std::string_view gesture) {
  if (edit.removed.empty() && edit.inserted.empty()) {
    return;
  }
  Note(journal_.NoteScript(edit));
  const size_t bytes = edit.removed.size() + edit.inserted.size();
  commands_.EditPatched(name, std::move(edit), bytes, gesture);
  OnScriptChanged();
}

void Workspace::ApplyToScript(const drama::TextEdit& edit) {
  if (const Status status = script_.Apply(edit); !status.ok()) {
    Tell(Message::Level::kError, status.message());  // our own history: does not happen
    return;
  }
  Note(journal_.NoteScript(edit));
  OnScriptChanged();
}

void Workspace::CancelGesture() {
  if (!commands_.in_gesture()) {
    return;
  }
  const std::vector<drama::TextEdit> patches = commands_.CancelGesture();
  for (auto patch = patches.rbegin(); patch != patches.rend(); ++patch) {
    ApplyToScript(patch->Reverse());
  }
  OnDocumentChanged();
}

void Workspace::Undo() {
  if (commands_.CanUndo()) {
    const std::span<const drama::TextEdit> patches = commands_.Undo();
    for (auto patch = patches.rbegin(); patch != patches.rend(); ++patch) {
      ApplyToScript(patch->Reverse());
    }
    OnDocumentChanged();
  }
}

void Workspace::Redo() {
  if (commands_.CanRedo()) {
    for (const drama::TextEdit& patch : commands_.Redo()) {
      ApplyToScript(patch);
    }
    OnDocumentChanged();
  }
}

void Workspace::Save() {
  LookOutside();
  WriteLines();
  if (changed_outside()) {
    Tell(Message::Level::kWarning,
         Tr("Nothing was saved: the project was also changed outside of this window. Choose above "
            "the messages which one to keep."));
    return;
  }
  std::error_code ignored;
  if (script_.text() != *saved_script_ || !std::filesystem::exists(paths_.Drama(), ignored)) {
    if (const Status status = WriteFileAtomically(paths_.Drama(), script_.text()); !status.ok()) {
      Tell(Message::Level::kError, status.message());
      return;
    }
    saved_script_ = script_.snapshot();
    script_stamp_ = FileStamp(paths_.Drama());
  }
  if (const Status status = SaveProject(paths_, document()); !status.ok()) {
    Tell(Message::Level::kError, status.message());
    return;
  }
  saved_project_ = commands_.snapshot();
  project_stamp_ = FileStamp(paths_.Project());
  commands_.MarkSaved();
  DiscardIfSaved();
  Tell(Message::Level::kInfo, Text(Tr("Saved %s"), paths_.folder.c_str()));
  preview_stale_ = true;
}

void Workspace::Note(const Status& journal) {
  if (!journal.ok()) {
    Tell(Message::Level::kError, journal.message());
  }
  constexpr uint64_t kLong = 64 << 20;  // bytes
  if (journal_.grown_bytes() > kLong) {
    if (const Status status = journal_.Restart(document(), script_.snapshot()); !status.ok()) {
      Tell(Message::Level::kError, status.message());
    }
  }
}

void Workspace::DiscardIfSaved() {
  const bool lines_are_written = document().lines == nullptr || document().lines == written_lines_;
  if (!commands_.dirty() && lines_are_written) {
    journal_.Discard(document(), script_.snapshot());
  }
}

void Workspace::OnScriptChanged() { since_script_ = 0.0; }

void Workspace::OnDocumentChanged() {
  since_lines_ = 0.0;
  since_edit_ = 0.0;
  Note(journal_.NoteProject(document()));
  DiscardIfSaved();
  AskForPictures();
  stage_changed_ = true;
  if (place() == nullptr && (!place_name_.empty() || !document().places.empty())) {
    // It was taken away, or is the first.
    ShowPlace(document().places.empty() ? "" : document().places.front().name);
    return;
  }
  ResolvePicksAgain();
  place_changed_ = true;
  preview_stale_ = true;
}

void Workspace::LookOutside() {
  if (std::string stamp = FileStamp(paths_.Drama()); stamp != script_stamp_) {
    script_stamp_ = std::move(stamp);
    const Result<std::string> text = ReadText(paths_.Drama(), drama::TimelineText::kMaxBytes);
    if (!text.ok()) {
      Tell(Message::Level::kWarning, Text(Tr("%s; saving writes it anew"), text.message().c_str()));
    } else if (*text != script_.text()) {
      outside_script_ = *text;
    } else {
      saved_script_ = script_.snapshot();
    }
  }
  if (std::string stamp = FileStamp(paths_.Project()); stamp != project_stamp_) {
    project_stamp_ = std::move(stamp);
    Result<ProjectDocument> project = LoadProject(paths_);
    if (!project.ok()) {
      Tell(Message::Level::kWarning,
           Text(Tr("%s; saving writes it anew"), project.message().c_str()));
    } else if (FormatProject(*project) != FormatProject(document())) {
      outside_project_ = std::make_shared<const ProjectDocument>(*std::move(project));
    }
  }
  if (changed_outside() && !commands_.dirty()) {
    TakeOutside();
  }
  // What somebody else writes into the table is an edit like any other.
  if (LinesStamp() != lines_stamp_) {
    written_lines_ = ReadLines();  // nullptr where it is damaged: then nothing is written over it
    const bool clean = !commands_.dirty();
    Edit(Tr("take over the lines"),
         [&](ProjectDocument& current) { current.lines = written_lines_; });
    if (clean) {
      commands_.MarkSaved();
      DiscardIfSaved();
    }
    preview_stale_ = true;
  }
}

void Workspace::TakeOutside() {
  if (outside_script_) {
    EditScript(Tr("take over drama.lua"), *std::exchange(outside_script_, std::nullopt));
    saved_script_ = script_.snapshot();
    Tell(Message::Level::kInfo,
         Tr("drama.lua was changed outside of this window and is read again."));
  }
  if (outside_project_) {
    Edit(Tr("take over project.json"), [&](ProjectDocument& current) {
      const auto lines = current.lines;
      current = *outside_project_;
      current.lines = lines;
    });
    outside_project_ = nullptr;
    saved_project_ = commands_.snapshot();
    Tell(Message::Level::kInfo,
         Tr("project.json was changed outside of this window and is read again."));
  }
  const bool all_saved = script_.text() == *saved_script_ &&
                         FormatProject(document()) == FormatProject(*saved_project_);
  if (all_saved) {
    commands_.MarkSaved();
    DiscardIfSaved();
  }
}

void Workspace::KeepOwn() {
  outside_script_.reset();
  outside_project_ = nullptr;
  saved_script_ = std::make_shared<const std::string>();  // whatever is there is not this
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
    EditPlace(Tr("lay the stage on the floor"),
              [&](PlaceDocument& edited) { edited.picked_from_stage = laid; });
  }
}

void Workspace::SetDistance(uint32_t from, uint32_t to, double metres) {
  if (place() == nullptr || loaded_.database == nullptr || !(metres > 0.0)) {
    return;
  }
  const Eigen::Vector3d from_in_map = loaded_.database->points[from].cast<double>();
  const Eigen::Vector3d to_in_map = loaded_.database->points[to].cast<double>();
  const geometry::Similarity3& now = place()->picked_from_stage;
  const geometry::Similarity3& map_from_picked = loaded_.picks.map_from_picked;
  const double said = StageDistance(map_from_picked * now, from_in_map, to_in_map);
  if (!(said > 0.0)) {
    return;
  }
  const geometry::Similarity3 scaled =
      ScaledToDistance(map_from_picked, now, from_in_map, to_in_map, metres);
  if (!(scaled.scale >= kMinStageScale && scaled.scale <= kMaxStageScale)) {
    Tell(Message::Level::kError, Tr("The stage was left as it is: by that distance it would be "
                                    "impossibly large or small."));
    return;
  }
  EditPlace(Tr("scale the stage"),
            [&](PlaceDocument& edited) { edited.picked_from_stage = scaled; });
  Tell(Message::Level::kInfo,
       Text(Tr("The stage was scaled: its metres said %.3f m where %.3f m were typed (%+.2f %%)."),
            said, metres, 100.0 * (said / metres - 1.0)));
}

void Workspace::ReloadMap() {
  if (unsaved_map_ || tasks_.Running(kKeeping)) {
    return;  // Update() tries again
  }
  const std::filesystem::path file = paths_.Scene(place_name_);
  std::error_code ignored;
  if (place() == nullptr || !std::filesystem::exists(file, ignored)) {
    map_stale_ = false;
    return;
  }
  using Database = std::shared_ptr<const vision::SceneDatabase>;
  const auto loaded = std::make_shared<Database>();
  const auto measures = std::make_shared<MapMeasures>();
  const auto statistics = std::make_shared<train::MapStatistics>();
  const auto report = std::make_shared<std::shared_ptr<const TrainingReport>>();
  const auto work = [=, place = *place(), paths = paths_](Progress& progress) {
    progress.Report("reading the map", 0.0);
    *report = ReadReport(MapAtHand(paths, place.name).report);
    LARARIUM_ASSIGN_OR_RETURN(vision::SceneDatabase database, vision::LoadSceneDatabase(file));
    progress.Report("looking for the floor and for tags", 0.5);
    *measures = MeasureMap(place, database);
    *statistics = train::MeasureStatistics(database);
    *loaded = std::make_shared<const vision::SceneDatabase>(std::move(database));
    return Status();
  };
  const auto done = [this, loaded, measures, statistics, report, name = place_name_,
                     key = TagsKey(*place()),
                     stamp = FileStamp(file)](const Status& status, bool cancelled) {
    if (!status.ok()) {
      Report(status, cancelled, "");
    } else if (name == place_name_) {
      loaded_.database = *loaded;
      scene_stamp_ = stamp;
      ++map_loads_;
      loaded_.statistics = statistics;
      loaded_.report = *report;
      loaded_.has_former = HasFormerMap(paths_, name);
      if (*report != nullptr && trained_place_ == name) {
        trained_place_.clear();
        report_is_new_ = true;
      }
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
  // Drawing on would open everything anew with each corner.
  const PlaceDocument at = WithoutDrafts(*place(), *loaded_.database);
  Json key = {{"place", at.name},
              {"map", map_loads_},
              {"training", at.training.path},
              {"preview", at.preview.path},
              {"view", {static_cast<int>(view_source_), live_camera_}}};
  for (const char* file : {"lines.csv", "lines.json", "paradata.json"}) {
    key["texts"].push_back(FileStamp(paths_.folder / file));
  }
  for (const SoundFile& sound : FindSounds(paths_)) {
    key["sounds"].push_back({sound.name, sound.built_in ? "" : FileStamp(sound.file)});
  }
  for (const OccluderDocument& occluder : at.occluders) {
    // What a shape measures and what else it does changes without opening anew.
    Json& entry = key["occluders"].emplace_back(
        Json::array({occluder.name, occluder.file, occluder.shape.has_value()}));
    if (occluder.drawn()) {
      // A depth is in metres, the map is not.
      const double scale = loaded_.picks.map_from_picked.scale * at.picked_from_stage.scale;
      entry.push_back({FormatOccluder(occluder)["corners"], occluder.depth * scale, occluder.flat});
    }
  }
  for (const ProbeDocument& probe : at.probes) {
    // How it lies and how bright it is changes without opening anew.
    key["probes"].push_back({probe.name, probe.file, FileStamp(paths_.Resolve(probe.file))});
  }
  for (const CastDocument& member : document().cast) {
    key["cast"].push_back(FormatCastMember(member));
  }
  for (const ObjectDocument& object : document().objects) {
    // Where it is changes without opening anew.
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
  const auto missing = std::make_shared<size_t>(0);  // people for whom others stand in
  const auto work = [content, report, missing, others_stand_in = PeopleLeft() > 0, paths = paths_,
                     document = commands_.snapshot(), script = script_.snapshot(),
                     name = place_name_, database = loaded_.database, baking = baking_,
                     map_from_picked = loaded_.picks.map_from_picked](Progress& progress) {
    *missing = others_stand_in ? PeopleToBake(paths, *document).size() : 0;
    if (*missing == 0) {
      const std::lock_guard turn(*baking);
      LARARIUM_ASSIGN_OR_RETURN(*report, app::Bake(paths, *document, progress));
    } else {
      LARARIUM_ASSIGN_OR_RETURN(*report,
                                app::Bake(paths, *document, progress, BakeWhat::kAllButPeople));
    }
    const PlaceDocument place = WithoutDrafts(*document->FindPlace(name), *database);
    LARARIUM_ASSIGN_OR_RETURN(*content,
                              AssembleShow(paths, *document, place, database, map_from_picked, {},
                                           *missing > 0 ? Unbuilt::kStandsIn : Unbuilt::kFails));
    content->drama = *script;  // as it is written now, saved or not
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
  if (tasks_.Start(kOpening, work, done)) {
    preview_key_ = std::move(key);
  } else {
    preview_stale_ = true;  // once the task at work has ended
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

void Workspace::ShowLiveCamera(const std::string& camera) {
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

FrameToPick Workspace::frame_to_pick() const {
  if (picture_ == nullptr || loaded_.database == nullptr) {
    return {std::nullopt, TrLater("There is no picture yet")};
  }
  if (view_source_ == ViewSource::kLive) {
    return {std::nullopt, TrLater("A live camera's images pass: pick in the training recording")};
  }
  if (picture_->frame != frame()) {
    return {std::nullopt, TrLater("The picture of this frame is on its way")};
  }
  if (tasks_.Running(kTraining)) {
    return {std::nullopt, TrLater("The place is being trained: pick when that is done")};
  }
  return FindFrameToPick(*picture_, *loaded_.database,
                         view_source_ == ViewSource::kTraining || !has_own_recording());
}

void Workspace::KeepFrame(const vision::Keyframe& keyframe) {
  auto database = WithFrame(loaded_.database, keyframe);
  if (database == loaded_.database) {
    return;
  }
  measures_stale_ |= tasks_.Running(kMeasuring);  // of the map as it was
  loaded_.database = std::move(database);
  auto statistics = std::make_shared<train::MapStatistics>(*loaded_.statistics);
  train::AddUnobserved(keyframe.session, *statistics);
  loaded_.statistics = std::move(statistics);
  picks_key_.clear();
  ResolvePicksAgain();
  unsaved_map_ = {paths_.Scene(place_name_), scene_stamp_, loaded_.database};
}

void Workspace::WriteMap() {
  if (FileStamp(unsaved_map_->file) != unsaved_map_->stamp) {
    unsaved_map_.reset();  // it was trained again, and that is read instead
    return;
  }
  const auto work = [map = *unsaved_map_](Progress&) {
    return vision::SaveSceneDatabase(map.file, *map.database);
  };
  const auto done = [this, file = unsaved_map_->file](const Status& status, bool) {
    if (!status.ok()) {
      Tell(Message::Level::kError, status.message());
    }
    if (file == paths_.Scene(place_name_)) {
      scene_stamp_ = FileStamp(file);
    }
  };
  if (tasks_.Start(kKeeping, work, done)) {
    unsaved_map_.reset();
  }
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
    const double rate = source->frames_per_second;
    const double frame = std::floor(time_ * rate + kSameFrame) + static_cast<double>(frames);
    SetTime(std::min(frame / rate, std::max(duration() - 1.0 / rate, time_)));
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
         tasks_.Running(kOpening);
}

void Workspace::RequestPicture() {
  if (preview_ == nullptr || loaded_.staged == nullptr || place() == nullptr) {
    return;
  }
  if (!recording()) {
    awaiting_picture_ = !preview_->failed();  // which frame it is to be is not known before
    return;
  }
  constexpr double kSettled = 0.4;  // seconds without edits
  PreviewRequest request;
  request.settled = since_edit_ >= kSettled;
  request.frame = frame();
  request.sound = playing_ && sound_;
  request.time = time_;
  request.onion = playing_ ? std::nullopt : onion_;
  // The new script is for the new stage.
  const bool wait = StageIsOutdated() && requested_text_ != nullptr;
  const int64_t revision = wait ? requested_script_ : script_.revision();
  request.script = wait ? requested_text_ : script_.snapshot();
  if (place_changed_) {
    auto staged = std::make_shared<stage::Place>(*loaded_.staged);
    const PlaceDocument& at = *place();
    staged->map_from_stage = loaded_.picks.map_from_picked * at.picked_from_stage;
    staged->camera_nudge = at.camera_nudge;
    staged->camera = camera_look_ ? at.camera : std::nullopt;
    staged->probes = RelitProbes(loaded_.baked_light, loaded_.baked_probes, at.probes);
    for (stage::Occluder& occluder : staged->occluders) {
      if (const OccluderDocument* known = at.FindOccluder(occluder.name)) {
        StageAnew(*known, staged->map_from_stage, occluder);
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
  if (unsaved_map_ && !tasks_.Running(kKeeping) && !tasks_.Running(kTraining)) {
    WriteMap();
  }
  if (map_stale_) {
    ReloadMap();
  }
  // Files are also edited outside of this window.
  constexpr double kFilesInterval = 1.0;
  since_files_checked_ += seconds;
  if (since_files_checked_ > kFilesInterval) {
    since_files_checked_ = 0.0;
    preview_stale_ = true;
    AskForPictures();
    LookOutside();
    // Trained by somebody else.
    map_stale_ |= loaded_.database != nullptr && !tasks_.Running(kTraining) &&
                  !tasks_.Running(kOpening) && !tasks_.Running(kKeeping) && !unsaved_map_ &&
                  FileStamp(paths_.Scene(place_name_)) != scene_stamp_;
  }
  since_script_ += seconds;
  since_lines_ += seconds;
  since_edit_ += seconds;
  constexpr double kPauseAfterLines = 0.8;  // seconds: whoever types goes on before
  if (since_lines_ > kPauseAfterLines) {
    WriteLines();
  }
  if (preview_ != nullptr && preview_->failed() && previewed_script_ != script_.revision()) {
    preview_key_.clear();  // the script may be what it failed for
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
  // Who is being changed is baked for their picture first; the stage follows. Where there is no
  // picture yet, others stand in.
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
    Tell(Message::Level::kError, problem.message());
    awaiting_picture_ = false;
  }
}

void Workspace::RunDramaAgain() {
  constexpr double kPause = 1.0;       // seconds without edits
  constexpr double kBehind = 30.0;     // seconds behind the last item
  constexpr double kShortest = 240.0;  // seconds of a drama that only its script knows
  const bool wanted = stage_changed_ || run_script_ != script_.revision();
  if (!wanted || since_script_ < kPause || tasks_.Running(kOpening) || cast_pictures_.Working() ||
      document().cast.empty()) {
    return;
  }
  if (tasks_.Running(kDryRun)) {
    tasks_.Cancel(kDryRun);  // what it would tell is not true any more
    return;
  }
  const auto run = std::make_shared<DramaRun>();
  const double seconds =
      std::min(std::max(script_.duration() + kBehind, kShortest), drama::Drama::kMaxTime);
  const auto work = [run, paths = paths_, document = commands_.snapshot(),
                     script = script_.snapshot(), seconds](Progress& progress) {
    run->missing_sounds = FindMissingSounds(paths, *document, *script);
    LARARIUM_ASSIGN_OR_RETURN(DramaRun played,
                              RunDrama(paths, *document, "", *script, seconds, progress));
    played.missing_sounds = std::move(run->missing_sounds);
    *run = std::move(played);
    return Status();
  };
  const auto done = [this, run, revision = script_.revision()](const Status& status,
                                                               bool cancelled) {
    if (cancelled) {
      return;
    }
    if (!status.ok()) {
      run->problems.push_back(status.message());
      if (drama_run_ != nullptr) {  // as long as nothing newer is known
        run->tasks = drama_run_->tasks;
        run->words = drama_run_->words;
        run->last = drama_run_->last;
        run->trails = drama_run_->trails;
        run->floor = drama_run_->floor;
      }
    } else {
      played_script_ = revision;
    }
    drama_run_ = run;
    ++drama_run_number_;
  };
  if (tasks_.Start(kDryRun, work, done)) {
    run_script_ = script_.revision();
    stage_changed_ = false;
  }
}

void Workspace::Check() {
  const auto result = std::make_shared<CommandResult>();
  tasks_.Start(
      kChecking,
      [result, project = paths_.folder](Progress& progress) {
        CheckOptions options;
        options.project = project;
        LARARIUM_ASSIGN_OR_RETURN(*result, RunCheck(options, progress));
        return Status();
      },
      [this, result](const Status& status, bool cancelled) {
        if (cancelled) {
          return;
        }
        checked_ = true;
        problems_.clear();
        warnings_.clear();
        if (!status.ok()) {
          problems_.push_back(status.message());
          return;
        }
        const auto take = [&](const char* kind, std::vector<std::string>& texts) {
          for (const Json& text : result->json.value(kind, Json::array())) {
            texts.push_back(text.get<std::string>());
          }
        };
        take("problems", problems_);
        take("warnings", warnings_);
      });
}

bool Workspace::BringInSound(const std::string& name, const std::filesystem::path& file) {
  if (const Status status = app::BringInSound(paths_, name, file); !status.ok()) {
    Tell(Message::Level::kError, status.message());
    return false;
  }
  Tell(Message::Level::kInfo,
       Text(Tr("Copied %s into the project's audio folder"), file.filename().c_str()));
  stage_changed_ = true;
  preview_stale_ = true;
  return true;
}

void Workspace::AskForPictures() {
  cast_pictures_.SetCast(document().cast);
  cast_pictures_.SetObjects(document().objects);
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
        Tr("The cast library is not installed; fetch it with scripts/fetch_cast_library.sh.");
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
          Edit(Tr("measure the camera"), [&](ProjectDocument& document) {
            if (PlaceDocument* place = document.FindPlace(name)) {
              place->camera = *traits;
            }
          });
        }
      });
}

void Workspace::RefineOccluder(const std::string& name, double search_m) {
  const std::shared_ptr<const stage::Place> staged = loaded_.staged;
  const OccluderDocument* occluder = place() == nullptr ? nullptr : place()->FindOccluder(name);
  if (occluder == nullptr || loaded_.database == nullptr || staged == nullptr) {
    return;
  }
  const auto solid =
      static_cast<size_t>(std::find_if(staged->occluders.begin(), staged->occluders.end(),
                                       [&](const stage::Occluder& o) { return o.name == name; }) -
                          staged->occluders.begin());
  if (solid == staged->occluders.size()) {
    return;
  }
  using Outcome = Result<train::RefineReport>;
  const auto outcome = std::make_shared<Outcome>(Status::Error(name, "was not refined"));
  const auto work = [=, document = *occluder, map = loaded_.database,
                     map_from_stage = loaded_.picks.map_from_picked *
                                      place()->picked_from_stage](Progress& progress) {
    *outcome = RefineOnMap(document, staged->occluders[solid].mesh, *map, map_from_stage, search_m,
                           progress);
    return outcome->status();
  };
  const auto done = [this, outcome, name, place = place_name_, start = occluder->stage_from_mesh](
                        const Status& status, bool cancelled) {
    const bool found = status.ok() && !cancelled;
    Report(status, cancelled, found ? name + ": " + RefineText(**outcome, true) : "");
    if (cancelled) {
      return;
    }
    refinement_ = {place, name, found ? (*outcome)->stage_from_mesh : start, *outcome};
    const PlaceDocument* at = document().FindPlace(place);
    const OccluderDocument* now = at == nullptr ? nullptr : at->FindOccluder(name);
    if (found && now != nullptr && now->stage_from_mesh == start) {
      Edit(Text(Tr("refine %s"), name.c_str()), [&](ProjectDocument& document) {
        document.FindPlace(place)->FindOccluder(name)->stage_from_mesh =
            refinement_->stage_from_mesh;
      });
    }
  };
  tasks_.Start(kRefining, work, done);
}

const Workspace::Refinement* Workspace::refinement(const OccluderDocument& occluder) const {
  const bool applies = refinement_ && refinement_->place == place_name_ &&
                       refinement_->occluder == occluder.name &&
                       refinement_->stage_from_mesh == occluder.stage_from_mesh;
  return applies ? &*refinement_ : nullptr;
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

void Workspace::SaveBones(const CastDocument& member) {
  if (review_ == nullptr || reviewed_name_ != member.name || tasks_.Running(kReview)) {
    return;  // what is known is not what is in use
  }
  if (const Status status = SaveBoneMap(paths_, member, *review_); !status.ok()) {
    Tell(Message::Level::kError, status.message());
    return;
  }
  const std::filesystem::path file = BoneMapFile(paths_, member);
  Edit(Text(Tr("save the bones of %s"), member.name.c_str()), [&](ProjectDocument& document) {
    for (CastDocument& known : document.cast) {
      if (known.name == member.name) {
        known.bone_map = paths_.Shorten(file);
        known.bones.clear();
      }
    }
  });
  Tell(Message::Level::kInfo, Text(Tr("Wrote %s"), file.c_str()));
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
               Text(Tr("%s: %d of %d images located, %d points."), name.c_str(),
                    static_cast<int>(report->located.size()), report->frames,
                    static_cast<int>(report->points)));
        if (status.ok() && !cancelled) {
          trained_place_ = name;
          done();
        }
        map_stale_ |= status.ok() && name == place_name_;
      });
  if (!started) {
    Tell(Message::Level::kWarning, Tr("A training is running already. Cancel it first."));
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
        Edit(Tr("add a session"), [&](ProjectDocument& document) {
          if (PlaceDocument* place = document.FindPlace(name)) {
            place->added.push_back(session);
          }
        });
      });
}

void Workspace::RemoveSession(uint32_t session) {
  if (place() == nullptr || session == 0 || session > place()->added.size()) {
    return;
  }
  if (!MapIsFree()) {
    return;
  }
  const auto removed = std::make_shared<train::RemovedSession>();
  const auto work = [removed, paths = paths_, place = *place(), session](Progress& progress) {
    LARARIUM_ASSIGN_OR_RETURN(*removed, RemoveFromMap(paths, place, session, progress));
    return Status();
  };
  const auto done = [this, removed, session, name = place_name_](const Status& status,
                                                                 bool cancelled) {
    Report(status, cancelled,
           Text(Tr("%s: a session was removed, with %d keyframes and %d points."), name.c_str(),
                static_cast<int>(removed->keyframes), static_cast<int>(removed->points)));
    if (!status.ok()) {
      return;
    }
    commands_.Rewrite([&](ProjectDocument& document) {
      if (PlaceDocument* place = document.FindPlace(name)) {
        ForgetSession(*place, session);
      }
    });
    map_stale_ |= name == place_name_;
    OnDocumentChanged();
  };
  tasks_.Start(kTraining, work, done);
}

bool Workspace::MapIsFree() {
  if (tasks_.Running(kTraining)) {
    Tell(Message::Level::kWarning, Tr("A training is running already. Cancel it first."));
    return false;
  }
  if (unsaved_map_ || tasks_.Running(kKeeping)) {  // would bring back what goes
    Tell(Message::Level::kWarning, Tr("The map is being written. Try again in a moment."));
    return false;
  }
  return true;
}

void Workspace::PutFormerMapBack() {
  if (place() == nullptr || !MapIsFree()) {
    return;
  }
  const Result<PlaceRecordings> recordings = app::PutFormerMapBack(paths_, *place());
  if (!recordings.ok()) {
    Tell(Message::Level::kError, recordings.message());
    return;
  }
  commands_.Rewrite([&](ProjectDocument& document) {
    if (PlaceDocument* place = document.FindPlace(place_name_)) {
      SetRecordings(*recordings, *place);
    }
  });
  map_stale_ = true;
  OnDocumentChanged();
  Tell(Message::Level::kInfo,
       Text(Tr("%s: the other map is in use. Doing so again changes back."), place_name_.c_str()));
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
               Text(Tr("Baked %d, %d were up to date."), static_cast<int>(report->baked.size()),
                    static_cast<int>(report->unchanged.size())));
        preview_key_.clear();
        preview_stale_ = true;
      });
}

void Workspace::Export(const ExportRequest& request) {
  Save();  // the drama is packed as its file is
  if (changed_outside() || commands_.dirty()) {
    export_problem_ = messages_.back().text;
    return;
  }
  const auto shown = std::make_shared<ExportedShow>();
  shown->file = request.out;
  export_problem_.clear();
  tasks_.Start(
      kExporting,
      [paths = paths_, document = commands_.snapshot(), request, shown,
       baking = baking_](Progress& progress) -> Status {
        const std::lock_guard turn(*baking);
        LARARIUM_RETURN_IF_ERROR(ExportProject(paths, *document, request, progress));
        LARARIUM_ASSIGN_OR_RETURN(shown->contents, ReadShowContents(request.out));
        return Status();
      },
      [this, shown](const Status& status, bool cancelled) {
        Report(status, cancelled, Text(Tr("Wrote %s"), shown->file.c_str()));
        if (status.ok() && !cancelled) {
          exported_ = shown;
        } else {
          export_problem_ =
              cancelled ? std::string(Tr("The export was cancelled.")) : status.message();
        }
      });
}

void Workspace::TryShow() {
  if (exported_ == nullptr || place() == nullptr) {
    return;
  }
  tasks_.Start(
      kTrying,
      [arguments = TrialArguments(paths_, *place(), exported_->file)](Progress& progress) {
        return RunProgram(FindPlayer(), arguments, progress);
      },
      [this](const Status& status, bool cancelled) {
        if (!status.ok() && !cancelled) {
          Tell(Message::Level::kError, status.message());
        }
      });
}

}  // namespace lararium::app
