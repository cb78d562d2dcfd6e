#pragma once

// The open project: its document and its drama with undo, the journal of unsaved edits, its files,
// and the place that is shown. Use it from the interface thread only.

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "editor/document/command_stack.h"
#include "editor/document/journal.h"
#include "editor/document/project.h"
#include "editor/document/project_lock.h"
#include "editor/document/script_document.h"
#include "editor/session/message_log.h"
#include "editor/session/project_files.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"

namespace lararium::editor {

class ProjectSession {
 public:
  using Commands = CommandStack<ProjectDocument, drama::TextEdit>;
  enum class Event {
    kEdited,         // The document changed by an edit, undo or redo; not the drama.
    kPlaceSelected,  // Another place is shown, or the same one from its beginning.
    kFilesChanged,   // Files of which the show is made were written, such as the lines.
  };

  // Reads the project, and edits that a crash left unsaved. messages must outlive the result.
  static Result<std::unique_ptr<ProjectSession>> Open(ProjectPaths paths, MessageLog& messages);
  // Writes the table of lines. Observers are not called any more.
  ~ProjectSession();
  ProjectSession(const ProjectSession&) = delete;
  ProjectSession& operator=(const ProjectSession&) = delete;

  // Observers are called at once, in the order in which they subscribed.
  void Subscribe(std::function<void(Event)> observer) { observers_.push_back(std::move(observer)); }
  void NoteFilesChanged() { Notify(Event::kFilesChanged); }

  const ProjectPaths& paths() const { return paths_; }
  const ProjectDocument& document() const { return commands_.document(); }
  const Commands& commands() const { return commands_; }
  // The drama. Its edits share the command stack with those of the document.
  const ScriptDocument& script() const { return script_; }

  // The place that the views show; nullptr where the project has none.
  const PlaceDocument* place() const { return document().FindPlace(place_name_); }
  const std::string& place_name() const { return place_name_; }
  void SelectPlace(const std::string& name);

  // Edits of the document. name: for undo and redo. gesture: see CommandStack::Edit.
  void Edit(const Sentence& name,
            const std::function<void(ProjectDocument&)>& change,
            std::string_view gesture = {});
  // Edits the current place; changes nothing where there is none.
  void EditPlace(const Sentence& name,
                 const std::function<void(PlaceDocument&)>& change,
                 std::string_view gesture = {});
  // Edits an occluder of the current place; changes nothing where it has none of that name.
  void EditOccluder(const Sentence& name,
                    const std::string& occluder,
                    const std::function<void(OccluderDocument&)>& change,
                    std::string_view gesture = {});
  // Edits of the drama. Returns false, and adds a message, where the change fails.
  bool EditTimeline(const Sentence& name,
                    const std::function<Status(drama::TimelineText&)>& change,
                    std::string_view gesture = {});
  void EditScript(const Sentence& name, std::string text, std::string_view gesture = {});
  // Edits the table of lines, document().lines, which must not be nullptr. Its file is written
  // shortly after the last edit, even when the project is not saved, because voices are made from
  // it. If the edited table could not be read back, nothing changes and a message tells why.
  void EditLines(const Sentence& name, bake::LineTable table, std::string_view gesture = {});
  // Changes a fact on disk in the document, which cannot be undone (CommandStack::Rewrite).
  void Rewrite(const std::function<void(ProjectDocument&)>& change);
  void EndGesture() { commands_.EndGesture(); }
  // Undoes the current gesture; does nothing outside a gesture.
  void CancelGesture();
  void Undo();
  void Redo();

  // Saves nothing while other programs' changes wait for the user's choice.
  void Save();
  // The project's files, with what other programs wrote into them.
  const ProjectFiles& files() const { return files_; }
  // Detects changes of the project's files by other programs. Adopts them where there are no
  // unsaved edits. A change of the table of lines is adopted as an edit in any case.
  void DetectExternalChanges();
  // Adopts the content of the files as an edit. Only where they can be read.
  void AdoptExternal();
  // Keeps the state of this window; saving will overwrite the files. A file that cannot be read is
  // kept as NAME.damaged.
  void KeepLocal();
  // Copies a recording into the project for a missing sound. Returns false, and adds a message,
  // where it is not a sound file.
  bool BringInSound(const std::string& name, const std::filesystem::path& file);

  // Call once for each frame of the interface. seconds: since the last call.
  void Update(double seconds);

 private:
  ProjectSession(ProjectLock lock,
                 ProjectPaths paths,
                 ProjectDocument document,
                 std::string script,
                 MessageLog& messages);

  void Recover();
  // Applies the content of a journal as an edit of the saved project.
  void TakeOver(JournalContent content);
  // Undo and redo of the part of a command that changes the drama.
  void ApplyToScript(const drama::TextEdit& edit);
  void RevertInScript(std::span<const drama::TextEdit> edits);
  void NoteScriptEdit(const Sentence& name, drama::TextEdit edit, std::string_view gesture);
  // Handles the result of writing to the journal.
  void Note(const Status& journal);
  // Removes the journal where all edits are saved.
  void DiscardIfSaved();
  void WriteLines();
  void OnDocumentChanged();
  void Notify(Event event) const;

  ProjectLock lock_;  // Released last.
  ProjectPaths paths_;
  MessageLog& messages_;
  Commands commands_;
  ScriptDocument script_;
  Journal journal_;
  ProjectFiles files_;
  double since_edit_ = 0.0;  // Seconds since the document was edited.
  std::string place_name_;
  std::vector<std::function<void(Event)>> observers_;
};

}  // namespace lararium::editor
