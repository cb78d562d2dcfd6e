#include "editor/app/line_commands.h"

#include <algorithm>
#include <utility>

#include "editor/app/caption_cues.h"
#include "editor/app/drama_run.h"
#include "editor/app/line_checks.h"
#include "editor/app/lines.h"
#include "editor/app/project.h"
#include "editor/bake/caption_file.h"
#include "shared/core/file.h"
#include "shared/stage/caption_file.h"

namespace lararium::app {
namespace {

Result<CommandResult> ImportCatalogue(const LinesOptions& options, bake::LineTable& table) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(options.import));
  LARARIUM_ASSIGN_OR_RETURN(const bake::PoFile po, bake::ParsePo(text, options.import.string()));
  const std::string language = options.language.empty() ? po.language : options.language;
  if (!stage::IsLanguageTag(language)) {
    return Status::Error(options.import.string(), "does not say which language it is in",
                         "name it with --language");
  }
  const bake::PoImport report = bake::ImportPo(po, language, table);
  CommandResult result;
  for (const std::string& unknown : report.unknown) {
    result.text += "warning: " + options.import.string() + ": " + unknown + ": means no line\n";
  }
  result.text += std::to_string(report.translated) + " texts in " + language + "\n";
  result.json = {
      {"translated", report.translated}, {"language", language}, {"unknown", report.unknown}};
  return result;
}

Result<bake::LineTable> ReadTable(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(file));
  return file.extension() == ".json" ? bake::ParseLinesJson(text, file.string())
                                     : bake::ParseLinesCsv(text, file.string());
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

// As captions that were placed by hand: audio/SPOKEN/LINE.LANGUAGE.srt.
Result<CommandResult> ImportCaptions(const CaptionsOptions& options,
                                     const ProjectPaths& paths,
                                     const std::string& spoken,
                                     const std::string& language,
                                     const std::vector<SaidLine>& said) {
  LARARIUM_ASSIGN_OR_RETURN(const std::string text, ReadText(options.import));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<bake::FileCue> cues,
                            bake::ParseCaptionFile(text, options.import.string()));
  std::vector<std::string> warnings;
  const auto lines = CuesByLine(cues, said, warnings);
  for (const auto& [line, own] : lines) {
    std::vector<stage::CaptionCue> placed;
    for (const bake::FileCue& cue : own) {
      placed.push_back({cue.begin, cue.end, cue.text});
    }
    LARARIUM_RETURN_IF_ERROR(stage::CheckCues(placed, options.import.string() + ": " + line));
  }
  std::error_code error;
  std::filesystem::create_directories(paths.Recordings(spoken), error);
  for (const auto& [line, own] : lines) {
    const std::string name = line + "." + language + ".srt";
    LARARIUM_RETURN_IF_ERROR(
        WriteFileAtomically(paths.Recordings(spoken) / name, bake::FormatSrt(own)));
  }
  CommandResult result;
  for (const std::string& warning : warnings) {
    result.text += "warning: " + options.import.string() + ": " + warning + "\n";
  }
  result.text += "captions of " + std::to_string(lines.size()) + " lines in " + language + "\n";
  result.json = {{"lines", lines.size()}, {"warnings", warnings}};
  return result;
}

}  // namespace

Result<CommandResult> RunLines(const LinesOptions& options) {
  const ProjectPaths paths{options.project};
  LARARIUM_RETURN_IF_ERROR(LoadProject(paths).status());
  LARARIUM_ASSIGN_OR_RETURN(bake::LineTable table, bake::LoadLines(paths.folder));
  CommandResult result;
  if (options.import.extension() == ".po") {
    LARARIUM_ASSIGN_OR_RETURN(result, ImportCatalogue(options, table));
  } else {
    LARARIUM_ASSIGN_OR_RETURN(table, ReadTable(options.import));
    result.text = std::to_string(table.lines.size()) + " lines\n";
    result.json = {{"lines", table.lines.size()}};
  }
  LARARIUM_RETURN_IF_ERROR(bake::SaveLines(paths.folder, table));
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
  LARARIUM_ASSIGN_OR_RETURN(const stage::CaptionBook book,
                            MakeCaptions(paths, document, lines, spoken));
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

}  // namespace lararium::app
