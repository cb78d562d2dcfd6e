#pragma once

// Where somebody sees what a check found: problems are texts, and say their places.

#include <optional>
#include <string>
#include <string_view>

#include "shared/drama/timeline_text.h"

namespace lararium::panels {

struct ProblemPlace {
  int script_line = 0;    // from 1; 0: it names none
  double seconds = -1.0;  // of the drama; below 0: it names no time
  std::string line;       // what is said, by its id; empty: it names none
};

// script: the name of its file.
ProblemPlace PlaceOfProblem(std::string_view problem, std::string_view script);

// Where a name stands as a word of its own; npos: nowhere.
size_t FindName(std::string_view problem, std::string_view name);

// The item that begins on a line of the script, and the first that says a line.
std::optional<drama::TimelineItem> ItemOnLine(const drama::TimelineText& text, int line);
std::optional<drama::TimelineItem> ItemSaying(const drama::TimelineText& text,
                                              const std::string& line);

}  // namespace lararium::panels
