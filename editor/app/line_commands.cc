#include "editor/app/line_commands.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

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
  LARARIUM_ASSIGN_OR_RETURN(const std::string script, ReadText(paths.Drama()));
  LARARIUM_ASSIGN_OR_RETURN(const auto staged, StageDrama(paths, document, spoken, script));
  LineListener listener(staged->stage, staged->content);
  LARARIUM_RETURN_IF_ERROR(PlayDry(*staged->drama, seconds, progress,
                                   [&] { listener.Listen(staged->drama->time()); }));
  return listener.said();
}

// Which line a cue of the whole drama belongs to: of those that are being said then, or can
// still be read, the one that began last.
const SaidLine* FindSaid(const std::vector<SaidLine>& said, double time) {
  constexpr double kEarly = 0.1;  // seconds that a cue may come before its line
  constexpr double kLate = 4.0;   // and after its end
  const SaidLine* found = nullptr;
  for (const SaidLine& line : said) {
    if (time >= line.begin - kEarly && time < line.begin + line.seconds + kLate &&
        (found == nullptr || line.begin >= found->begin)) {
      found = &line;
    }
  }
  return found;
}

// The cues of each line when it is said for the first time, by its own time.
std::map<std::string, std::vector<bake::FileCue>> CuesByLine(const std::vector<bake::FileCue>& cues,
                                                             const std::vector<SaidLine>& said,
                                                             std::vector<std::string>& warnings) {
  std::map<std::string, std::vector<bake::FileCue>> lines;
  std::map<std::string, double> first;
  for (const SaidLine& line : said) {
    first.emplace(line.line, line.begin);
  }
  for (const bake::FileCue& cue : cues) {
    const SaidLine* line = FindSaid(said, cue.begin);
    if (line == nullptr) {
      char text[64];
      std::snprintf(text, sizeof(text), "nobody speaks at %.2f s: '", cue.begin);
      warnings.push_back(text + cue.text + "'");
    } else if (first[line->line] == line->begin) {
      std::vector<bake::FileCue>& own = lines[line->line];
      const double begin = std::max(cue.begin - line->begin, own.empty() ? 0.0 : own.back().end);
      own.push_back({"", begin, std::max(cue.end - line->begin, begin + 0.001), cue.text});
    }
  }
  return lines;
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
