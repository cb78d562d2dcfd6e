#pragma once

// The files of an open project that other programs can change too: project.json, drama.lua and the
// table of lines. Writes them, and finds what other programs wrote.

#include <filesystem>
#include <memory>
#include <string>

#include "editor/bake/line_table.h"
#include "editor/document/project.h"
#include "editor/session/message_log.h"
#include "shared/core/status.h"

namespace lararium::editor {

class ProjectFiles {
 public:
  using Script = std::shared_ptr<const std::string>;
  using Document = std::shared_ptr<const ProjectDocument>;
  using Lines = std::shared_ptr<const bake::LineTable>;

  // script, document: what the files hold. document also has their table of lines.
  ProjectFiles(ProjectPaths paths, Script script, Document document, MessageLog& messages);

  // Writes drama.lua where its text differs, and project.json.
  Status Save(Script script, Document document);
  // Whether drama.lua and project.json hold this content.
  bool Hold(const std::string& script, const ProjectDocument& document) const;

  // Finds changes of drama.lua and project.json since the last call. script, document: the content
  // in this window; a file with equal content is not a change. A file that another program removed
  // is not a change either, because the next Save() writes it again.
  void DetectChanges(const Script& script, const ProjectDocument& document);
  // Whether another program changed a file or made it unreadable.
  bool changed_outside() const {
    return script_.outside != nullptr || document_.outside != nullptr || !damage().empty();
  }
  // Why a changed file cannot be read; empty: all can be read.
  const std::string& damage() const {
    return script_.damage.empty() ? document_.damage : script_.damage;
  }
  // Returns the version of another program once; nullptr: there is none.
  Script TakeScript();
  Document TakeDocument();
  // Forgets the versions of other programs, so that Save() overwrites them. A file that cannot be
  // read is copied to NAME.damaged before, so that its author can correct it.
  void KeepLocal();

  // Whether the files of the table of lines changed since they were last read or written.
  bool LinesChanged() const { return LinesStamp() != lines_stamp_; }
  // Returns nullptr, and adds a message, where the table cannot be read.
  Lines ReadLines();
  // Whether the file holds this table. nullptr stands for a table that cannot be read and that must
  // not be overwritten.
  bool LinesAreWritten(const Lines& lines) const { return lines == nullptr || lines == lines_; }
  Status WriteLines(Lines lines);

 private:
  template <typename Content>
  struct File {
    std::filesystem::path path;
    std::shared_ptr<const Content> content;  // nullptr: it is not that of this window.
    std::string stamp;                       // The stamp when it was last read or written.
    std::shared_ptr<const Content> outside;  // The version of another program.
    std::string damage;                      // Why that version cannot be read.

    void NoteWritten(std::shared_ptr<const Content> written);
    // Notes a change of the file's stamp. Returns whether it changed.
    bool Changed();
    std::shared_ptr<const Content> TakeOutside();
  };

  template <typename Content>
  void ReportUnreadable(File<Content>& file, const std::string& problem);
  template <typename Content>
  void ForgetOutside(File<Content>& file);
  std::string LinesStamp() const;

  ProjectPaths paths_;
  MessageLog& messages_;
  File<std::string> script_;
  File<ProjectDocument> document_;
  Lines lines_;
  std::string lines_stamp_;
};

}  // namespace lararium::editor
