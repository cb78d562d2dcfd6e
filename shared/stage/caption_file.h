#pragma once

// captions.json of a bundle: the captions of all lines in all caption languages, for one spoken
// language (docs/file-formats.md).

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::stage {

// One text on the screen: at most two lines, separated by '\n'.
struct CaptionCue {
  double begin = 0.0;  // Seconds since the line began.
  double end = 0.0;    // Seconds; may lie after the end of the line, to leave time to read.
  std::string text;    // UTF-8..

  friend bool operator==(const CaptionCue&, const CaptionCue&) = default;
};

struct CaptionBook {
  template <typename T>
  using ByLanguage = std::map<std::string, T, std::less<>>;
  template <typename T>
  using ById = std::map<std::string, T, std::less<>>;

  ById<ByLanguage<std::string>> names;              // Names of the speakers.
  ById<ByLanguage<std::vector<CaptionCue>>> lines;  // Cues ascend and do not overlap.

  friend bool operator==(const CaptionBook&, const CaptionBook&) = default;
};

// Whether the tag follows the part of BCP 47 that is used here, such as "la" or "pt-BR": letters,
// digits and '-', at most 16 characters.
bool IsLanguageTag(std::string_view tag);

// Checks the order, the duration and the number of text lines of the cues.
Status CheckCues(const std::vector<CaptionCue>& cues, const std::string& where);

// Error messages begin with `where` and name the field.
Result<CaptionBook> ParseCaptions(std::string_view text, const std::string& where);
std::string FormatCaptions(const CaptionBook& book);

}  // namespace lararium::stage
