#include "editor/cli/line_commands.h"

#include <algorithm>
#include <utility>

#include "editor/bake/caption_file.h"
#include "editor/check/caption_cues.h"
#include "editor/check/drama_run.h"
#include "editor/check/line_checks.h"
#include "editor/cli/command_arguments.h"
#include "editor/document/line_edits.h"
#include "editor/document/project.h"
#include "editor/jobs/lines.h"
#include "shared/core/file.h"
#include "shared/core/lower_case.h"
#include "shared/stage/caption_file.h"

namespace lararium::editor {
namespace {

// "warning: FILE: line 12: ...", one a line.
std::string WarningLines(const std::filesystem::path& file,
                         const std::vector<std::string>& warnings) {
  std::string text;
  for (const std::string& warning : warnings) {
    text += "warning: " + file.string() + ": " + warning + "\n";
  }
  return text;
}

Result<CommandResult> ImportCatalogue(const LinesOptions& options, bake::LineTable& table) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(options.import));
  LARARIUM_ASSIGN_OR_RETURN(const bake::PoFile po, bake::ParsePo(text, options.import.string()));
  std::string language = options.language.empty() ? po.language : options.language;
  // A catalogue for "it-IT" translates the column "it" if there is no other.
  const std::string base = language.substr(0, language.find('-'));
  const auto has = [&table](const std::string& tag) {
    return std::find(table.languages.begin(), table.languages.end(), tag) != table.languages.end();
  };
  language = options.language.empty() && !has(language) && has(base) ? base : language;
  if (!stage::IsLanguageTag(language)) {
    return Status::Error(options.import.string(), "does not state its language",
                         "give it with --language");
  }
  const bake::PoImport report = bake::ImportPo(po, language, table);
  CommandResult result;
  std::vector<std::string> warnings = po.notes;
  for (const std::string& unknown : report.unknown) {
    warnings.push_back(unknown + ": means no line");
  }
  if (report.fuzzy > 0) {
    warnings.push_back(std::to_string(report.fuzzy) + " fuzzy entries were left out");
  }
  result.text = WarningLines(options.import, warnings);
  result.text += std::to_string(report.translated) + " texts in " + language + "\n";
  result.json = {{"translated", report.translated},
                 {"language", language},
                 {"unknown", report.unknown},
                 {"warnings", warnings}};
  return result;
}

Result<bake::LinesFile> ReadTable(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file));
  return LowerCase(file.extension().string()) == ".json" ? bake::ReadLinesJson(text, file.string())
                                                         : bake::ReadLinesCsv(text, file.string());
}

Result<CommandResult> Import(const LinesOptions& options, bake::LineTable& table) {
  if (LowerCase(options.import.extension().string()) == ".po") {
    return ImportCatalogue(options, table);
  }
  LARARIUM_ASSIGN_OR_RETURN(bake::LinesFile file, ReadTable(options.import));
  table = std::move(file.table);
  CommandResult result;
  std::vector<std::string> warnings;
  if (!file.note.empty()) {
    warnings.push_back(file.note);
  }
  for (const Status& left_out : file.left_out) {
    warnings.push_back(left_out.message() + "; it was left out");
  }
  for (const std::string& warning : warnings) {
    result.text += "warning: " + warning + "\n";
  }
  result.text += std::to_string(table.lines.size()) + " lines\n";
  result.json = {{"lines", table.lines.size()}, {"warnings", warnings}};
  return result;
}

Result<bake::Line*> FindLine(const LinesOptions& options,
                             const std::string& id,
                             bake::LineTable& table) {
  std::string known;
  for (bake::Line& line : table.lines) {
    if (line.id == id) {
      return &line;
    }
    known += (known.empty() ? "" : ", ") + line.id;
  }
  return Status::Error(options.project.string(), "there is no line \"" + id + "\"",
                       known.empty() ? "add it with --add" : "there are " + known);
}

// "LANGUAGE=TEXT"
Status SetText(const std::string& id, const std::string& text, bake::LineTable& table) {
  const size_t equals = text.find('=');
  const std::string language = text.substr(0, equals);
  if (equals == std::string::npos || !stage::IsLanguageTag(language)) {
    return Status::Error("--text " + text, "does not begin with a language",
                         "write it as la=Salvete!");
  }
  table = WithText(std::move(table), id, "", language, text.substr(equals + 1));
  return Status();
}

Status ChangeLine(const LinesOptions& options, const std::string& id, bake::LineTable& table) {
  LARARIUM_ASSIGN_OR_RETURN(bake::Line * line, FindLine(options, id, table));
  line->speaker = options.speaker.value_or(line->speaker);
  line->notes = options.notes.value_or(line->notes);
  for (const std::string& text : options.texts) {
    LARARIUM_RETURN_IF_ERROR(SetText(id, text, table));
  }
  return Status();
}

Status AddLine(const LinesOptions& options, bake::LineTable& table) {
  LARARIUM_RETURN_IF_ERROR(CheckPlainName("--add", options.add));
  if (table.Find(options.add) != nullptr) {
    return Status::Error("--add", "the line \"" + options.add + "\" exists already",
                         "change it with --set");
  }
  table = WithLine(std::move(table), options.add, options.speaker.value_or(""));
  return ChangeLine(options, options.add, table);
}

CommandResult ListLines(const bake::LineTable& table) {
  CommandResult result;
  result.json = {{"languages", table.languages}, {"lines", Json::array()}};
  for (const bake::Line& line : table.lines) {
    result.text += line.id + (line.speaker.empty() ? "" : ", " + line.speaker) + ":\n";
    for (const std::string& language : table.languages) {
      if (const auto text = line.text.find(language); text != line.text.end()) {
        result.text += "  " + language + ": " + text->second + "\n";
      }
    }
    result.json["lines"].push_back(
        {{"id", line.id}, {"speaker", line.speaker}, {"notes", line.notes}, {"text", line.text}});
  }
  if (table.lines.empty()) {
    result.text = "no lines; add one with --add ID --speaker NAME --text la=TEXT\n";
  }
  return result;
}

// Performs the edit, if one is given, and lists the lines.
Result<CommandResult> EditLines(const LinesOptions& options, bake::LineTable& table) {
  if (!options.add.empty()) {
    LARARIUM_RETURN_IF_ERROR(AddLine(options, table));
  } else if (!options.set.empty()) {
    LARARIUM_RETURN_IF_ERROR(ChangeLine(options, options.set, table));
  } else if (!options.remove.empty()) {
    LARARIUM_ASSIGN_OR_RETURN(const bake::Line* line, FindLine(options, options.remove, table));
    table.lines.erase(table.lines.begin() + (line - table.lines.data()));
  } else if (!options.add_language.empty()) {
    if (!stage::IsLanguageTag(options.add_language)) {
      return Status::Error("--add-language",
                           "'" + options.add_language + "' is not a valid language tag",
                           "use one such as la, it or en");
    }
    table = WithLanguage(std::move(table), options.add_language);
  }
  return ListLines(table);
}

Result<std::vector<SaidLine>> RunForLines(const ProjectPaths& paths,
                                          const ProjectDocument& document,
                                          const std::string& spoken,
                                          double seconds,
                                          Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string script, ReadText(paths.Drama()));
  LARARIUM_ASSIGN_OR_RETURN(const auto staged, StageDrama(paths, document, spoken, script));
  LineListener listener(staged->stage, staged->content);
  LARARIUM_RETURN_IF_ERROR(
      PlayDry(*staged->drama, seconds, progress, [&] { listener.Listen(staged->drama->time()); }));
  return listener.said();
}

// Imports captions as hand-timed captions of lines: audio/SPOKEN/LINE.LANGUAGE.srt.
Result<CommandResult> ImportCaptions(const CaptionsOptions& options,
                                     const ProjectPaths& paths,
                                     const std::string& spoken,
                                     const std::string& language,
                                     const std::vector<SaidLine>& said) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(options.import));
  LARARIUM_ASSIGN_OR_RETURN(bake::CaptionFile file,
                            bake::ParseCaptionFile(text, options.import.string()));
  std::vector<std::string>& warnings = file.notes;
  const auto lines = CuesByLine(std::move(file.cues), said, warnings);
  std::error_code error;
  std::filesystem::create_directories(paths.Recordings(spoken), error);
  for (const auto& [line, own] : lines) {
    const std::string name = line + "." + language + ".srt";
    LARARIUM_RETURN_IF_ERROR(
        WriteFileAtomically(paths.Recordings(spoken) / name, bake::FormatSrt(own)));
  }
  CommandResult result{WarningLines(options.import, warnings), {}};
  result.text += "captions of " + std::to_string(lines.size()) + " lines in " + language + "\n";
  result.json = {{"lines", lines.size()}, {"warnings", warnings}};
  return result;
}

}  // namespace

Result<CommandResult> RunLines(const LinesOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_RETURN_IF_ERROR(LoadProject(paths).status());
  LARARIUM_ASSIGN_OR_RETURN(bake::LineTable table, bake::LoadLines(paths.folder));
  const bake::LineTable before = table;
  LARARIUM_ASSIGN_OR_RETURN(CommandResult result, options.import.empty() ? EditLines(options, table)
                                                                         : Import(options, table));
  if (table != before) {
    LARARIUM_RETURN_IF_ERROR(bake::SaveLines(paths.folder, table));
  }
  return result;
}

Result<CommandResult> RunCaptions(const CaptionsOptions& options, Progress& progress) {
  const ProjectPaths paths{options.project};
  LARARIUM_ASSIGN_OR_RETURN(const ProjectDocument document, LoadProject(paths));
  LARARIUM_ASSIGN_OR_RETURN(const ProjectLines lines, LoadProjectLines(paths, document));
  const std::string place = paths.Project().string();
  LARARIUM_ASSIGN_OR_RETURN(const std::string spoken,
                            show::ChooseLanguage(lines.spoken, options.spoken, "speech", place));
  LARARIUM_ASSIGN_OR_RETURN(
      const std::string language,
      show::ChooseLanguage(lines.captions, options.language, "captions", place));
  LARARIUM_ASSIGN_OR_RETURN(const auto spoken_lines, SpokenLines(paths, document, lines));
  LARARIUM_ASSIGN_OR_RETURN(const stage::CaptionBook book,
                            MakeCaptions(document, lines, spoken_lines, spoken));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<SaidLine> said,
                            RunForLines(paths, document, spoken, options.seconds, progress));
  if (!options.import.empty()) {
    return ImportCaptions(options, paths, spoken, language, said);
  }
  const std::vector<bake::FileCue> cues = CuesOf(said, book, language);
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(options.out, options.out.extension() == ".vtt"
                                                                ? bake::FormatVtt(cues)
                                                                : bake::FormatSrt(cues)));
  return CommandResult{options.out.string() + ": " + std::to_string(cues.size()) + " captions\n",
                       {{"out", options.out.string()}, {"captions", cues.size()}}};
}

}  // namespace lararium::editor
