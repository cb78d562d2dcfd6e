#pragma once

// Reads and writes the caption files of other programs: SubRip (.srt) and WebVTT (.vtt).

#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

struct FileCue {
  std::string id;      // The identifier in WebVTT, the number in SubRip.
  double begin = 0.0;  // seconds
  double end = 0.0;
  std::string text;  // UTF-8, rows separated by '\n', no style tags.

  friend bool operator==(const FileCue&, const FileCue&) = default;
};

// Gives the cues in file order. Removes tags (<i>, <c.x>, {\an8}) and decodes entities. Errors
// name the text as `where`, and the line.
Result<std::vector<FileCue>> ParseSrt(std::string_view text, const std::string& where);
Result<std::vector<FileCue>> ParseVtt(std::string_view text, const std::string& where);
// Chooses the format by the first line.
Result<std::vector<FileCue>> ParseCaptionFile(std::string_view text, const std::string& where);

std::string FormatSrt(const std::vector<FileCue>& cues);  // Numbers the cues from 1.
std::string FormatVtt(const std::vector<FileCue>& cues);

}  // namespace lararium::bake
