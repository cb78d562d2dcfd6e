#include "editor/panels/dialogs/problem_place.h"

#include <cctype>
#include <cstdlib>
#include <functional>

#include "editor/panels/timeline/timeline_rows.h"

namespace lararium::panels {

using drama::TimelineItem;
using drama::TimelineText;

namespace {

// Reads the time of "... (at 12.34 s)".
double TimeOf(std::string_view problem) {
  const size_t at = problem.rfind("(at ");
  return at == std::string_view::npos
             ? -1.0
             : std::strtod(std::string(problem.substr(at + 4)).c_str(), nullptr);
}

// Reads the id of "lines.csv:7: line 'hail' ...".
std::string LineIdOf(std::string_view problem) {
  constexpr std::string_view kBefore = "line '";
  const size_t at = problem.find(kBefore);
  if (at == std::string_view::npos) {
    return "";
  }
  const size_t begin = at + kBefore.size();
  const size_t end = problem.find('\'', begin);
  return end == std::string_view::npos ? "" : std::string(problem.substr(begin, end - begin));
}

bool IsNamePart(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

std::optional<TimelineItem> FirstItem(const TimelineText& text,
                                      const std::function<bool(TimelineItem)>& is_meant) {
  for (size_t lane = 0; lane < text.lanes().size(); ++lane) {
    for (size_t i = 0; i < text.lanes()[lane].size(); ++i) {
      if (const TimelineItem item{lane, i}; is_meant(item)) {
        return item;
      }
    }
  }
  return std::nullopt;
}

}  // namespace

ProblemPlace PlaceOfProblem(std::string_view problem, std::string_view script) {
  return {LineOfPlace(problem, script), TimeOf(problem), LineIdOf(problem)};
}

size_t FindName(std::string_view problem, std::string_view name) {
  for (size_t at = problem.find(name); at != std::string_view::npos && !name.empty();
       at = problem.find(name, at + 1)) {
    const size_t end = at + name.size();
    const bool begins = at == 0 || !IsNamePart(problem[at - 1]);
    const bool ends = end == problem.size() || !IsNamePart(problem[end]);
    if (begins && ends) {
      return at;
    }
  }
  return std::string_view::npos;
}

std::optional<TimelineItem> ItemOnLine(const TimelineText& text, int line) {
  return FirstItem(
      text, [&](TimelineItem item) { return text.LineOf(item) == static_cast<size_t>(line); });
}

std::optional<TimelineItem> ItemSaying(const TimelineText& text, const std::string& line) {
  return FirstItem(text, [&](TimelineItem item) {
    const std::optional<Json> said = text.Field(item, "line");
    return said && said->is_string() && said->get<std::string>() == line;
  });
}

}  // namespace lararium::panels
