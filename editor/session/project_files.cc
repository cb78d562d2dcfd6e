#include "editor/session/project_files.h"

#include <system_error>
#include <utility>

#include "editor/document/file_stamp.h"
#include "editor/text/text.h"
#include "shared/core/file.h"
#include "shared/drama/timeline_text.h"

namespace lararium::editor {

template <typename Content>
void ProjectFiles::File<Content>::NoteWritten(std::shared_ptr<const Content> written) {
  content = std::move(written);
  stamp = FileStamp(path);
}

template <typename Content>
bool ProjectFiles::File<Content>::Changed() {
  std::string now = FileStamp(path);
  if (now == stamp) {
    return false;
  }
  stamp = std::move(now);
  damage.clear();
  outside = nullptr;
  return true;
}

template <typename Content>
std::shared_ptr<const Content> ProjectFiles::File<Content>::TakeOutside() {
  content = outside != nullptr ? outside : content;
  return std::exchange(outside, nullptr);
}

ProjectFiles::ProjectFiles(ProjectPaths paths,
                           Script script,
                           Document document,
                           MessageLog& messages)
    : paths_(std::move(paths)), messages_(messages) {
  lines_ = document->lines;
  lines_stamp_ = LinesStamp();
  script_.path = paths_.Drama();
  script_.NoteWritten(std::move(script));
  document_.path = paths_.Project();
  document_.NoteWritten(std::move(document));
}

Status ProjectFiles::Save(Script script, Document document) {
  if (script_.content == nullptr || *script != *script_.content || !FileExists(script_.path)) {
    LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(script_.path, *script));
    script_.NoteWritten(std::move(script));
  }
  LARARIUM_RETURN_IF_ERROR(SaveProject(paths_, *document));
  document_.NoteWritten(std::move(document));
  return Status();
}

bool ProjectFiles::Hold(const std::string& script, const ProjectDocument& document) const {
  return script_.content != nullptr && script == *script_.content && document_.content != nullptr &&
         FormatProject(document) == FormatProject(*document_.content);
}

void ProjectFiles::DetectChanges(const Script& script, const ProjectDocument& document) {
  if (script_.Changed()) {
    Result<std::string> text = ReadText(script_.path, drama::TimelineText::kMaxBytes);
    if (!text.ok()) {
      ReportUnreadable(script_, text.message());
    } else if (*text != *script) {
      script_.outside = std::make_shared<const std::string>(*std::move(text));
    } else {
      script_.content = script;
    }
  }
  if (document_.Changed()) {
    Result<ProjectDocument> project = LoadProject(paths_);
    if (!project.ok()) {
      ReportUnreadable(document_, project.message());
    } else if (FormatProject(*project) != FormatProject(document)) {
      document_.outside = std::make_shared<const ProjectDocument>(*std::move(project));
    }
  }
}

// A removed file can be written again; a file that another program has just written, with a mistake
// in it, must be kept.
template <typename Content>
void ProjectFiles::ReportUnreadable(File<Content>& file, const std::string& problem) {
  if (FileExists(file.path)) {
    file.damage = problem;
  } else {
    messages_.Tell(Message::Level::kWarning,
                   Text(Tr("%s; saving writes it again"), problem.c_str()));
  }
}

ProjectFiles::Script ProjectFiles::TakeScript() { return script_.TakeOutside(); }
ProjectFiles::Document ProjectFiles::TakeDocument() { return document_.TakeOutside(); }

void ProjectFiles::KeepLocal() {
  ForgetOutside(script_);
  ForgetOutside(document_);
}

template <typename Content>
void ProjectFiles::ForgetOutside(File<Content>& file) {
  if (!file.damage.empty()) {
    std::filesystem::path kept = file.path;
    kept += ".damaged";
    std::error_code error;
    std::filesystem::copy_file(file.path, kept, std::filesystem::copy_options::overwrite_existing,
                               error);
    messages_.Tell(
        Message::Level::kInfo,
        error ? Text(Tr("%s could not be kept: %s"), file.path.c_str(), error.message().c_str())
              : Text(Tr("What was written outside is kept as %s."), kept.c_str()));
  }
  file.damage.clear();
  file.outside = nullptr;
  file.content = nullptr;
}

std::string ProjectFiles::LinesStamp() const {
  return FileStamp(paths_.folder / "lines.csv") + FileStamp(paths_.folder / "lines.json");
}

ProjectFiles::Lines ProjectFiles::ReadLines() {
  lines_stamp_ = LinesStamp();
  Result<bake::LineTable> table = bake::LoadLines(paths_.folder);
  lines_ = messages_.TellFailure(table.status())
               ? nullptr
               : std::make_shared<const bake::LineTable>(*std::move(table));
  return lines_;
}

Status ProjectFiles::WriteLines(Lines lines) {
  LARARIUM_RETURN_IF_ERROR(bake::SaveLines(paths_.folder, *lines));
  lines_ = std::move(lines);
  lines_stamp_ = LinesStamp();
  return Status();
}

}  // namespace lararium::editor
