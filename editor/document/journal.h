#pragma once

// Keeps the unsaved edits, even when the program is killed: every edit is written to the file
// before the next one begins, and reaches the disk soon after. A thread writes the steps of a
// gesture as fast as it can, so that a drag does not wait for it. The next start reads what a crash
// left.
//
// The file holds the project, the drama and the table of lines as their files have them, followed
// by one record for each change: a JSON patch (RFC 6902) of the project, or an edit of the drama's
// text or of the table's text. Each record has a length and a checksum, so that a truncated record
// is detected.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "editor/document/project.h"
#include "shared/core/json.h"
#include "shared/core/mailbox.h"
#include "shared/core/status.h"
#include "shared/drama/timeline_text.h"

namespace lararium::editor {

class Journal {
 public:
  // Writes no file before the first edit. project, script: the state before the first edit.
  Journal(std::filesystem::path file,
          const ProjectDocument& project,
          std::shared_ptr<const std::string> script);
  // Leaves the file on the disk.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // Call after each edit; NoteProject() also covers edits of the lines. After an error nothing more
  // is written until the next Restart().
  Status NoteProject(const ProjectDocument& now);
  // Call after each step of a gesture instead of NoteProject(). Formatting a large project takes
  // longer than a frame of the interface, so the journal's thread does it; where steps come faster,
  // it writes the newest one. Returns the error of an earlier step.
  Status NoteGesture(std::shared_ptr<const ProjectDocument> now);
  Status NoteScript(const drama::TextEdit& edit);

  // Call after saving: removes the file. The arguments are the state before the next edits.
  void Discard(const ProjectDocument& project, std::shared_ptr<const std::string> script);
  // Replaces the file with one that holds this state and no edits.
  Status Restart(const ProjectDocument& project, std::shared_ptr<const std::string> script);

  // By how many bytes the file has grown since it was begun. Restart() makes it short again.
  uint64_t grown_bytes() const { return grown_; }

 private:
  class Descriptor;

  // Opens the file to append to it; returns nullptr where that fails.
  std::shared_ptr<const Descriptor> Open() const;
  // Sets the state with which the file begins.
  void Begin(const ProjectDocument& project, std::shared_ptr<const std::string> script);
  std::string Beginning() const;
  Status Append(std::string_view header, std::string_view payload);
  Status NoteLines(const ProjectDocument& now);
  void Close();
  Status WriteProject(const ProjectDocument& now);

  // The project after a step of a gesture.
  struct Step {
    uint64_t number;
    std::shared_ptr<const ProjectDocument> project;
  };
  // Does nothing where the step is not the newest state any more.
  void WriteStep(const Step& step);

  const std::filesystem::path file_;
  std::mutex mutex_;                           // Protects the members up to failure_.
  Json project_;                               // The state at the end of the file.
  std::shared_ptr<const std::string> script_;  // The state at the beginning of the file.
  // The state at the end of the file; nullptr: the file has no lines.
  std::shared_ptr<const bake::LineTable> lines_;
  std::string lines_text_;                        // lines_ as text.
  std::shared_ptr<const Descriptor> descriptor_;  // nullptr: not open.
  bool failed_ = false;
  Status failure_;                    // The error of a step that was not returned yet.
  std::atomic<uint64_t> newest_ = 0;  // The number of the newest state of the project.
  std::atomic<uint64_t> grown_ = 0;
  // Files to be synchronised to the disk. They stay open until that is done.
  Mailbox<std::shared_ptr<const Descriptor>> written_;
  std::jthread syncer_;
  Mailbox<Step> steps_;
  std::jthread writer_;
};

struct JournalContent {
  ProjectDocument project;  // lines: nullptr where the journal has none.
  std::string script;
  int edits = 0;      // The number of edits since the last saving.
  bool torn = false;  // The last record is truncated.
  // Whether the file of lines holds a state from this journal: it was not changed by another
  // program since.
  bool lines_are_ours = false;
};

// Reads what a crash left. Returns nullopt where there is no file, and an error where it cannot be
// read (the file stays). lines: the table as its file holds it now; nullptr: the file cannot be
// read.
Result<std::optional<JournalContent>> LoadJournal(const std::filesystem::path& file,
                                                  const bake::LineTable* lines);

}  // namespace lararium::editor
