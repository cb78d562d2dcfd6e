#include "editor/app/line_commands.h"

#include <algorithm>
#include <utility>

#include "editor/app/line_checks.h"
#include "editor/app/lines.h"
#include "editor/app/project.h"
#include "editor/bake/caption_file.h"
#include "shared/core/file.h"
#include "shared/drama/drama.h"
#include "shared/stage/stage.h"

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

// The captions of all that was said. One is gone when the next begins, as readers of these
// files show one at a time.
std::vector<bake::FileCue> CuesOf(const std::vector<SaidLine>& said,
                                  const stage::CaptionBook& book,
                                  const std::string& language) {
  std::vector<bake::FileCue> cues;
  for (const SaidLine& line : said) {
    const auto languages = book.lines.find(line.line);
    const auto found = languages == book.lines.end() ? decltype(languages->second.end())()
                                                     : languages->second.find(language);
    if (languages == book.lines.end() || found == languages->second.end()) {
      continue;
    }
    int number = 0;
    for (const stage::CaptionCue& cue : found->second) {
      if (line.cut && cue.begin >= line.seconds) {
        break;
      }
      const double end = line.cut ? std::min(cue.end, line.seconds) : cue.end;
      cues.push_back({line.line + "/" + std::to_string(++number), line.begin + cue.begin,
                      line.begin + end, cue.text});
    }
  }
  std::stable_sort(cues.begin(), cues.end(),
                   [](const auto& a, const auto& b) { return a.begin < b.begin; });
  for (size_t i = 0; i + 1 < cues.size(); ++i) {
    cues[i].end = std::max(std::min(cues[i].end, cues[i + 1].begin), cues[i].begin + 0.001);
  }
  return cues;
}

Result<std::vector<SaidLine>> RunForLines(const ProjectPaths& paths,
                                          const ProjectDocument& document,
                                          const std::string& spoken,
                                          double seconds,
                                          Progress& progress) {
  stage::Stage stage;
  show::ShowContent content;
  LARARIUM_RETURN_IF_ERROR(FillStage(paths, document, spoken, stage, content));
  LARARIUM_ASSIGN_OR_RETURN(const std::string script, ReadText(paths.Drama()));
  const std::shared_ptr<Log> silent = MakeSilentLog();
  LARARIUM_ASSIGN_OR_RETURN(
      const auto drama,
      drama::Drama::Create(script, paths.Drama().filename().string(), stage, {}, *silent));
  LineListener listener(stage, content);
  const auto ticks = static_cast<int64_t>(seconds * drama::Drama::kTicksPerSecond);
  for (int64_t tick = 0; tick < ticks; ++tick) {
    drama->Tick();
    listener.Listen(drama->time());
    progress.Report("running the drama",
                    static_cast<double>(tick + 1) / static_cast<double>(ticks));
    if (progress.Cancelled()) {
      return Status::Error("captions", "cancelled");
    }
  }
  return listener.said();
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
  const std::vector<bake::FileCue> cues = CuesOf(said, book, language);
  LARARIUM_RETURN_IF_ERROR(WriteFileAtomically(options.out, options.out.extension() == ".vtt"
                                                                ? bake::FormatVtt(cues)
                                                                : bake::FormatSrt(cues)));
  return CommandResult{options.out.string() + ": " + std::to_string(cues.size()) + " captions\n",
                       {{"out", options.out.string()}, {"captions", cues.size()}}};
}

}  // namespace lararium::app
