#pragma once

// Keeps what was edited since the last saving, also when the program is killed: every edit
// is handed to the system before the next one begins, and reaches the disk soon after. What
// a crash leaves is read at the next start.
//
// The file holds the project, the drama and the table of lines as their files have them and then
// one record for each change: a JSON patch (RFC 6902) of the project, or an edit of the drama's
// text or of the table's. Each record has its length and a check sum, so that one that was cut off
// is known.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "editor/app/project.h"
#include "shared/core/json.h"
#include "shared/core/mailbox.h"
#include "shared/core/status.h"
#include "shared/drama/timeline_text.h"

namespace lararium::app {

class Journal {
 public:
  // No file is written before the first edit. base: what the edits start from.
  Journal(std::filesystem::path file,
          const ProjectDocument& project,
          std::shared_ptr<const std::string> script);
  // What was written stays.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  // After an edit, of the lines too. On an error nothing more is written until the next Restart().
  Status NoteProject(const ProjectDocument& now);
  Status NoteScript(const drama::TextEdit& edit);

  // Everything is saved, and this is what the next edits start from: removes the file.
  void Discard(const ProjectDocument& project, std::shared_ptr<const std::string> script);
  // The file holds this and no edits, at once instead of what it held.
  Status Restart(const ProjectDocument& project, std::shared_ptr<const std::string> script);

  // How long the file has grown since it was begun: Restart() makes it short again.
  uint64_t grown_bytes() const { return grown_; }

 private:
  // What the file begins with, or with what was noted ends.
  void Begin(const ProjectDocument& project, std::shared_ptr<const std::string> script);
  std::string Beginning() const;
  Status Append(std::string_view header, std::string_view payload);
  Status NoteLines(const ProjectDocument& now);
  void Close();

  std::filesystem::path file_;
  Json project_;                                  // as the file ends
  std::shared_ptr<const std::string> script_;     // as it begins
  std::shared_ptr<const bake::LineTable> lines_;  // as it ends, nullptr: it has none,
  std::string lines_text_;                        // and as text
  int descriptor_ = -1;
  bool failed_ = false;
  uint64_t grown_ = 0;
  Mailbox<int> written_;  // descriptors to bring to the disk
  std::jthread syncer_;
};

struct JournalContent {
  ProjectDocument project;  // lines: nullptr where the journal has none
  std::string script;
  int edits = 0;      // since they were saved
  bool torn = false;  // the last record was cut off
  // The file of lines holds what it held when the journal began or after one of its edits: nobody
  // else has written it since.
  bool lines_are_ours = false;
};

// What a crash left: nullopt where there is nothing, an error where it cannot be read (it is
// left where it is). lines: as their file holds them now; nullptr: it cannot be read.
Result<std::optional<JournalContent>> LoadJournal(const std::filesystem::path& file,
                                                  const bake::LineTable* lines);

}  // namespace lararium::app
