#pragma once

// Finds where to show a problem of a check. Problems are texts that contain their location.

#include <optional>
#include <string>
#include <string_view>

#include "shared/drama/timeline_text.h"

namespace lararium::panels {

struct ProblemPlace {
  int script_line = 0;    // Line number from 1; 0: the text names no line.
  double seconds = -1.0;  // Time of the drama; below 0: the text names no time.
  std::string line;       // The id of a spoken line; empty: the text names none.
};

// script: the name of the script's file.
ProblemPlace PlaceOfProblem(std::string_view problem, std::string_view script);

// The position of a name as a separate word; npos: it does not occur.
size_t FindName(std::string_view problem, std::string_view name);

// The item that begins on a line of the script, and the first item that says a line.
std::optional<drama::TimelineItem> ItemOnLine(const drama::TimelineText& text, int line);
std::optional<drama::TimelineItem> ItemSaying(const drama::TimelineText& text,
                                              const std::string& line);

}  // namespace lararium::panels
