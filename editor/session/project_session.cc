#include "editor/session/project_session.h"

#include <system_error>
#include <utility>

#include "editor/document/missing_files.h"
#include "editor/jobs/sounds.h"
#include "editor/text/text.h"
#include "shared/core/file.h"

namespace lararium::editor {

Result<std::unique_ptr<ProjectSession>> ProjectSession::Open(ProjectPaths paths,
                                                             MessageLog& messages) {
  LARARIUM_ASSIGN_OR_RETURN(ProjectLock lock, ProjectLock::Take(paths));
  LARARIUM_ASSIGN_OR_RETURN(ProjectDocument document, LoadProject(paths));
  // A project without its drama can be opened: a message reports the missing file, and saving makes
  // it.
  std::string script;
  if (FileExists(paths.Drama())) {
    LARARIUM_ASSIGN_OR_RETURN(script, ReadText(paths.Drama(), drama::TimelineText::kMaxBytes));
  }
  Result<bake::LineTable> lines = bake::LoadLines(paths.folder);
  if (!messages.TellFailure(lines.status())) {
    document.lines = std::make_shared<const bake::LineTable>(*std::move(lines));
  }
  std::unique_ptr<ProjectSession> project(new ProjectSession(
      std::move(lock), std::move(paths), std::move(document), std::move(script), messages));
  if (project->lock_.read_only()) {
    messages.Tell(Message::Level::kWarning,
                  Tr("The folder of the project cannot be written: no edit can be saved. Copy the "
                     "project to a folder of your own to edit it."));
  }
  project->Recover();
  for (const Status& missing : FindMissingFiles(project->paths_, project->document())) {
    messages.Tell(Message::Level::kWarning, missing.message());
  }
  if (!project->document().places.empty()) {
    project->SelectPlace(project->document().places.front().name);
  }
  return project;
}

ProjectSession::ProjectSession(ProjectLock lock,
                               ProjectPaths paths,
                               ProjectDocument document,
                               std::string script,
                               MessageLog& messages)
    : lock_(std::move(lock)),
      paths_(std::move(paths)),
      messages_(messages),
      commands_(std::move(document)),
      script_(std::move(script), paths_.Drama().filename().string()),
      journal_(paths_.Journal(), commands_.document(), script_.snapshot()),
      files_(paths_, script_.snapshot(), commands_.snapshot(), messages) {}

ProjectSession::~ProjectSession() {
  observers_.clear();
  WriteLines();
}

void ProjectSession::Recover() {
  Result<std::optional<JournalContent>> left =
      LoadJournal(paths_.Journal(), document().lines.get());
  if (!left.ok()) {
    const std::filesystem::path aside = paths_.folder / "journal.damaged";
    std::error_code error;
    std::filesystem::rename(paths_.Journal(), aside, error);
    messages_.Tell(Message::Level::kWarning,
                   Text(Tr("%s; it was moved to %s and the project opened as saved"),
                        left.message().c_str(), aside.c_str()));
    return;
  }
  if (!left->has_value() || (*left)->edits == 0) {
    journal_.Discard(document(), script_.snapshot());
    return;
  }
  TakeOver(std::move(**left));
}

void ProjectSession::TakeOver(JournalContent content) {
  const std::shared_ptr<const bake::LineTable> in_file = document().lines;
  std::shared_ptr<const bake::LineTable>& lines = content.project.lines;
  const bool lines_are_theirs = lines != nullptr && !content.lines_are_ours;
  if (lines == nullptr || (in_file != nullptr && *lines == *in_file)) {
    lines = in_file;
  }
  if (lines == in_file && files_.Hold(content.script, content.project)) {
    journal_.Discard(document(), script_.snapshot());  // All edits are in their files.
    return;
  }
  // Writes the journal first, so that its content is never lost.
  Note(journal_.Restart(content.project, std::make_shared<const std::string>(content.script)));
  drama::TextEdit edit = script_.Replace(std::move(content.script));
  const size_t bytes = edit.removed.size() + edit.inserted.size();
  commands_.Edit(
      Sentence("recover"), [&](ProjectDocument& current) { current = std::move(content.project); },
      "recover");
  commands_.EditPatched(Sentence("recover"), std::move(edit), bytes, "recover");
  commands_.EndGesture();
  OnDocumentChanged();
  messages_.Tell(Message::Level::kWarning,
                 content.torn ? Tr("Edits that were not saved have been recovered, without the "
                                   "last one. Undo takes them back.")
                              : Tr("Edits that were not saved have been recovered. Undo "
                                   "takes them back."));
  if (lines_are_theirs) {  // Handled like a change that has just happened.
    Edit(Sentence("take over the lines"),
         [&](ProjectDocument& current) { current.lines = in_file; });
    if (in_file != nullptr) {
      messages_.Tell(Message::Level::kInfo,
                     Tr("The lines were changed outside of this window and are read again."));
    }
  }
}

void ProjectSession::Notify(Event event) const {
  for (const std::function<void(Event)>& observer : observers_) {
    observer(event);
  }
}

void ProjectSession::SelectPlace(const std::string& name) {
  place_name_ = name;
  Notify(Event::kPlaceSelected);
}

void ProjectSession::Edit(const Sentence& name,
                          const std::function<void(ProjectDocument&)>& change,
                          std::string_view gesture) {
  commands_.Edit(name, change, gesture);
  OnDocumentChanged();
}

void ProjectSession::EditPlace(const Sentence& name,
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

void ProjectSession::EditOccluder(const Sentence& name,
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

bool ProjectSession::EditTimeline(const Sentence& name,
                                  const std::function<Status(drama::TimelineText&)>& change,
                                  std::string_view gesture) {
  Result<drama::TextEdit> edit = script_.Change(change);
  if (messages_.TellFailure(edit.status())) {
    return false;
  }
  NoteScriptEdit(name, *std::move(edit), gesture);
  return true;
}

void ProjectSession::EditScript(const Sentence& name, std::string text, std::string_view gesture) {
  NoteScriptEdit(name, script_.Replace(std::move(text)), gesture);
}

void ProjectSession::EditLines(const Sentence& name,
                               bake::LineTable table,
                               std::string_view gesture) {
  // The journal and the file store the table as CSV, so it must be possible to read it back.
  const auto read_back = bake::ParseLinesCsv(bake::FormatLinesCsv(table), "the lines");
  if (messages_.TellFailure(read_back.status())) {
    return;
  }
  auto next = std::make_shared<const bake::LineTable>(std::move(table));
  Edit(
      name, [&](ProjectDocument& document) { document.lines = next; }, gesture);
}

void ProjectSession::Rewrite(const std::function<void(ProjectDocument&)>& change) {
  commands_.Rewrite(change);
  OnDocumentChanged();
}

void ProjectSession::NoteScriptEdit(const Sentence& name,
                                    drama::TextEdit edit,
                                    std::string_view gesture) {
  if (edit.removed.empty() && edit.inserted.empty()) {
    return;
  }
  Note(journal_.NoteScript(edit));
  const size_t bytes = edit.removed.size() + edit.inserted.size();
  commands_.EditPatched(name, std::move(edit), bytes, gesture);
}

void ProjectSession::ApplyToScript(const drama::TextEdit& edit) {
  // The edit is from the project's own history, so it cannot fail.
  if (!messages_.TellFailure(script_.Apply(edit))) {
    Note(journal_.NoteScript(edit));
  }
}

void ProjectSession::RevertInScript(std::span<const drama::TextEdit> edits) {
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit) {
    ApplyToScript(edit->Reverse());
  }
  OnDocumentChanged();
}

void ProjectSession::CancelGesture() {
  if (commands_.in_gesture()) {
    RevertInScript(commands_.CancelGesture());
  }
}

void ProjectSession::Undo() {
  if (commands_.CanUndo()) {
    RevertInScript(commands_.Undo());
  }
}

void ProjectSession::Redo() {
  if (commands_.CanRedo()) {
    for (const drama::TextEdit& patch : commands_.Redo()) {
      ApplyToScript(patch);
    }
    OnDocumentChanged();
  }
}

void ProjectSession::Save() {
  DetectExternalChanges();
  WriteLines();
  if (files_.changed_outside()) {
    messages_.Tell(
        Message::Level::kWarning,
        Tr("Nothing was saved: the project was also changed outside of this window. Choose below "
           "which one to keep."));
    return;
  }
  if (messages_.TellFailure(files_.Save(script_.snapshot(), commands_.snapshot()))) {
    return;
  }
  commands_.MarkSaved();
  DiscardIfSaved();
  messages_.Tell(Message::Level::kInfo, Text(Tr("Saved %s"), paths_.folder.c_str()));
}

void ProjectSession::WriteLines() {
  if (files_.LinesAreWritten(document().lines) || files_.LinesChanged()) {
    return;  // DetectExternalChanges() adopts a change of the file first.
  }
  if (messages_.TellFailure(files_.WriteLines(document().lines))) {
    since_edit_ = 0.0;  // Prevents an attempt in every frame.
    return;
  }
  NoteFilesChanged();
  DiscardIfSaved();
}

void ProjectSession::Note(const Status& journal) {
  messages_.TellFailure(journal);
  constexpr uint64_t kLong = 64 << 20;  // Bytes.
  if (journal_.grown_bytes() > kLong) {
    messages_.TellFailure(journal_.Restart(document(), script_.snapshot()));
  }
}

void ProjectSession::DiscardIfSaved() {
  if (!commands_.dirty() && files_.LinesAreWritten(document().lines)) {
    journal_.Discard(document(), script_.snapshot());
  }
}

void ProjectSession::OnDocumentChanged() {
  since_edit_ = 0.0;
  Note(commands_.in_gesture() ? journal_.NoteGesture(commands_.snapshot())
                              : journal_.NoteProject(document()));
  DiscardIfSaved();
  if (place() == nullptr && (!place_name_.empty() || !document().places.empty())) {
    // The place was removed, or it is the first one.
    SelectPlace(document().places.empty() ? "" : document().places.front().name);
  }
  Notify(Event::kEdited);
}

void ProjectSession::DetectExternalChanges() {
  const bool known = files_.changed_outside();
  const bool damaged = !files_.damage().empty();
  files_.DetectChanges(script_.snapshot(), document());
  if (files_.changed_outside() && files_.damage().empty() && !commands_.dirty()) {
    AdoptExternal();
  }
  if (damaged && !files_.changed_outside()) {
    messages_.Tell(Message::Level::kInfo, Tr("What was changed outside can be read again."));
  }
  if (!known && files_.changed_outside()) {
    messages_.Tell(
        Message::Level::kWarning,
        files_.damage().empty()
            ? Tr("The project was changed outside of this window as well. Choose below which one "
                 "to keep.")
            : Text(Tr("%s: it was changed outside of this window. Mend it there, or keep what is "
                      "here."),
                   files_.damage().c_str()));
  }
  if (files_.LinesChanged()) {
    const bool clean = !commands_.dirty();
    Edit(Sentence("take over the lines"),
         [&](ProjectDocument& current) { current.lines = files_.ReadLines(); });
    if (clean) {
      commands_.MarkSaved();
      DiscardIfSaved();
    }
  }
}

void ProjectSession::AdoptExternal() {
  if (const ProjectFiles::Script script = files_.TakeScript()) {
    EditScript(Sentence("take over drama.lua"), *script);
    messages_.Tell(Message::Level::kInfo,
                   Tr("drama.lua was changed outside of this window and is read again."));
  }
  if (const ProjectFiles::Document theirs = files_.TakeDocument()) {
    Edit(Sentence("take over project.json"), [&](ProjectDocument& current) {
      const auto lines = current.lines;
      current = *theirs;
      current.lines = lines;
    });
    messages_.Tell(Message::Level::kInfo,
                   Tr("project.json was changed outside of this window and is read again."));
  }
  if (files_.Hold(script_.text(), document())) {
    commands_.MarkSaved();
    DiscardIfSaved();
  }
}

void ProjectSession::KeepLocal() {
  files_.KeepLocal();
  commands_.MarkUnsaved();
}

bool ProjectSession::BringInSound(const std::string& name, const std::filesystem::path& file) {
  if (messages_.TellFailure(editor::BringInSound(paths_, name, file))) {
    return false;
  }
  messages_.Tell(Message::Level::kInfo,
                 Text(Tr("Copied %s into the project's audio folder"), file.filename().c_str()));
  NoteFilesChanged();
  return true;
}

void ProjectSession::Update(double seconds) {
  constexpr double kPauseAfterLines = 0.8;  // Seconds; longer than a pause while typing.
  since_edit_ += seconds;
  if (since_edit_ > kPauseAfterLines) {
    WriteLines();
  }
}

}  // namespace lararium::editor
