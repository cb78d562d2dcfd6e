#include "editor/session/workspace.h"

#include <utility>

#include "editor/document/file_stamp.h"
#include "editor/document/user_folders.h"
#include "shared/core/file.h"

namespace lararium::editor {

namespace {

constexpr size_t kMaxMessages = 200;

}  // namespace

Result<std::unique_ptr<Workspace>> Workspace::Open(ProjectPaths paths, Log& log) {
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  // A project without its drama can be opened: a message reports the missing file, and saving makes
  // it.
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
    workspace->SelectPlace(workspace->document().places.front().name);
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
  tasks_ = TaskList();  // Waits for running writes.
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
    journal_.Discard(document(), script_.snapshot());  // All edits are in their files.
    return;
  }
  // Writes the journal first, so that its content is never lost.
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
  if (lines_are_theirs) {  // Handled like a change that has just happened.
    Edit(Tr("take over the lines"), [&](ProjectDocument& current) { current.lines = in_file; });
    if (in_file != nullptr) {
      Tell(Message::Level::kInfo,
           Tr("The lines were changed outside of this window and are read again."));
    }
  }
}

void Workspace::Tell(Message::Level level, std::string text) {
  if (!messages_.empty() && messages_.back().text == text) {
    return;  // The message was already shown.
  }
  messages_.push_back({level, std::move(text)});
  ++told_;
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

void Workspace::SelectPlace(const std::string& name) {
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
  // The journal and the file store the table as CSV, so it must be possible to read it back.
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
    return;  // Another program has written it; DetectExternalChanges() adopts that first.
  }
  if (const Status status = bake::SaveLines(paths_.folder, *document().lines); !status.ok()) {
    Tell(Message::Level::kError, status.message());
    since_lines_ = 0.0;  // Prevents an attempt in every frame.
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
    // Cannot happen: the edit is from our own history.
    Tell(Message::Level::kError, status.message());
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
  DetectExternalChanges();
  WriteLines();
  if (changed_outside()) {
    Tell(Message::Level::kWarning,
         Tr("Nothing was saved: the project was also changed outside of this window. Choose below "
            "which one to keep."));
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
  constexpr uint64_t kLong = 64 << 20;  // Bytes.
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
    // The place was removed, or it is the first one.
    SelectPlace(document().places.empty() ? "" : document().places.front().name);
    return;
  }
  ResolvePicksAgain();
  place_changed_ = true;
  preview_stale_ = true;
}

namespace {

bool IsThere(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

// Whether a file has changed since stamp; then updates stamp and clears damage.
bool IsAnother(const std::filesystem::path& file, std::string& stamp, std::string& damage) {
  std::string now = FileStamp(file);
  if (now == stamp) {
    return false;
  }
  stamp = std::move(now);
  damage.clear();
  return true;
}

}  // namespace

void Workspace::LookAtScript() {
  if (!IsAnother(paths_.Drama(), script_stamp_, script_damage_)) {
    return;
  }
  outside_script_.reset();
  const Result<std::string> text = ReadText(paths_.Drama(), drama::TimelineText::kMaxBytes);
  if (!text.ok()) {
    ReportUnreadable(paths_.Drama(), text.message(), script_damage_);
  } else if (*text != script_.text()) {
    outside_script_ = *text;
  } else {
    saved_script_ = script_.snapshot();
  }
}

void Workspace::LookAtProject() {
  if (!IsAnother(paths_.Project(), project_stamp_, project_damage_)) {
    return;
  }
  outside_project_ = nullptr;
  Result<ProjectDocument> project = LoadProject(paths_);
  if (!project.ok()) {
    ReportUnreadable(paths_.Project(), project.message(), project_damage_);
  } else if (FormatProject(*project) != FormatProject(document())) {
    outside_project_ = std::make_shared<const ProjectDocument>(*std::move(project));
  }
}

// A deleted file can be written again; a file that another program has just written, with a mistake
// in it, must be kept.
void Workspace::ReportUnreadable(const std::filesystem::path& file,
                                 const std::string& problem,
                                 std::string& damage) {
  if (IsThere(file)) {
    damage = problem;
  } else {
    Tell(Message::Level::kWarning, Text(Tr("%s; saving writes it anew"), problem.c_str()));
  }
}

void Workspace::DetectExternalChanges() {
  const bool known = changed_outside();
  const bool damaged = !outside_damage().empty();
  LookAtScript();
  LookAtProject();
  if (changed_outside() && outside_damage().empty() && !commands_.dirty()) {
    AdoptExternal();
  }
  if (damaged && !changed_outside()) {
    Tell(Message::Level::kInfo, Tr("What was changed outside can be read again."));
  }
  if (!known && changed_outside()) {
    Tell(Message::Level::kWarning,
         outside_damage().empty()
             ? Tr("The project was changed outside of this window as well. Choose below which one "
                  "to keep.")
             : Text(Tr("%s: it was changed outside of this window. Mend it there, or keep what is "
                       "here."),
                    outside_damage().c_str()));
  }
  // A change of the table by another program is a normal edit.
  if (LinesStamp() != lines_stamp_) {
    written_lines_ = ReadLines();  // nullptr where it is damaged; then nothing overwrites it.
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

void Workspace::AdoptExternal() {
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

void Workspace::KeepLocal() {
  if (!script_damage_.empty()) {
    KeepDamaged(paths_.Drama());
  }
  if (!project_damage_.empty()) {
    KeepDamaged(paths_.Project());
  }
  script_damage_.clear();
  project_damage_.clear();
  outside_script_.reset();
  outside_project_ = nullptr;
  // The content of the file is not that of this window.
  saved_script_ = std::make_shared<const std::string>();
  commands_.MarkUnsaved();
}

// Keeps the file, so that its author can correct it.
void Workspace::KeepDamaged(const std::filesystem::path& file) {
  std::filesystem::path kept = file;
  kept += ".damaged";
  std::error_code error;
  std::filesystem::copy_file(file, kept, std::filesystem::copy_options::overwrite_existing, error);
  Tell(Message::Level::kInfo,
       error ? Text(Tr("%s could not be kept: %s"), file.c_str(), error.message().c_str())
             : Text(Tr("What was written outside is kept as %s."), kept.c_str()));
}

}  // namespace lararium::editor
