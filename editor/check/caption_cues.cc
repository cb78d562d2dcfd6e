#include "editor/check/caption_cues.h"

#include <algorithm>
#include <cstdio>

namespace lararium::editor {
namespace {

// The line that a cue of the complete drama belongs to: the one during which it is shown longest,
// because programs that round to seconds begin cues before their lines. A cue that is shown during
// no line belongs to the last one that can still be read.
const SaidLine* FindSaid(const std::vector<SaidLine>& said, const bake::FileCue& cue) {
  constexpr double kLate = 4.0;  // Seconds that a cue may follow the end of its line.
  const SaidLine* found = nullptr;
  double longest = -kLate;
  for (const SaidLine& line : said) {
    const double shared =
        std::min(cue.end, line.begin + line.seconds) - std::max(cue.begin, line.begin);
    if (shared > longest && (shared > 0.0 || cue.begin >= line.begin)) {
      found = &line;
      longest = shared;
    }
  }
  return found;
}

}  // namespace

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

std::map<std::string, std::vector<bake::FileCue>> CuesByLine(std::vector<bake::FileCue> cues,
                                                             const std::vector<SaidLine>& said,
                                                             std::vector<std::string>& warnings) {
  std::stable_sort(cues.begin(), cues.end(),
                   [](const auto& a, const auto& b) { return a.begin < b.begin; });
  std::map<std::string, std::vector<bake::FileCue>> lines;
  std::map<std::string, double> first;
  for (const SaidLine& line : said) {
    first.emplace(line.line, line.begin);
  }
  for (const bake::FileCue& cue : cues) {
    const SaidLine* line = FindSaid(said, cue);
    if (line == nullptr) {
      char text[64];
      std::snprintf(text, sizeof(text), "nobody speaks at %.2f s: '", cue.begin);
      warnings.push_back(text + cue.text + "'");
    } else if (first[line->line] == line->begin) {
      std::vector<bake::FileCue>& own = lines[line->line];
      const double begin = std::max(cue.begin - line->begin, 0.0);
      own.push_back({"", begin, std::max(cue.end - line->begin, begin + 0.001), cue.text});
    }
  }
  return lines;
}

}  // namespace lararium::editor
