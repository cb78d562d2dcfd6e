#pragma once

// Captions as other programs have them: SubRip (.srt) and WebVTT (.vtt).

#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

struct FileCue {
  std::string id;      // of WebVTT; of SubRip the number
  double begin = 0.0;  // seconds
  double end = 0.0;
  std::string text;  // UTF-8, rows apart by '\n', without marks of style

  friend bool operator==(const FileCue&, const FileCue&) = default;
};

// Cues in the order of the file. Tags (<i>, <c.x>, {\an8}) are left out, entities replaced.
// place: what errors call the text; they name the line.
Result<std::vector<FileCue>> ParseSrt(std::string_view text, const std::string& place);
Result<std::vector<FileCue>> ParseVtt(std::string_view text, const std::string& place);
// By its first line.
Result<std::vector<FileCue>> ParseCaptionFile(std::string_view text, const std::string& place);

std::string FormatSrt(const std::vector<FileCue>& cues);  // numbers them anew
std::string FormatVtt(const std::vector<FileCue>& cues);

}  // namespace lararium::bake
