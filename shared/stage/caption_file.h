#pragma once

// captions.json of a bundle: what is to be read while lines are said in one language, in
// all languages that there are (docs/file-formats.md).

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::stage {

// One text on the screen: at most two lines, apart by '\n'.
struct CaptionCue {
  double begin = 0.0;  // seconds since the line began to be said
  double end = 0.0;    // may lie after the line's own end, so that there is time to read
  std::string text;    // UTF-8

  friend bool operator==(const CaptionCue&, const CaptionCue&) = default;
};

struct CaptionBook {
  template <typename T>
  using ByLanguage = std::map<std::string, T, std::less<>>;
  template <typename T>
  using ById = std::map<std::string, T, std::less<>>;

  ById<ByLanguage<std::string>> names;              // of speakers
  ById<ByLanguage<std::vector<CaptionCue>>> lines;  // cues ascend and do not overlap

  friend bool operator==(const CaptionBook&, const CaptionBook&) = default;
};

// BCP 47 as far as we need it: "la", "pt-BR"; letters, digits and '-', at most 16.
bool IsLanguageTag(std::string_view tag);

// What is wrong with the cues, if anything: order, length, lines.
Status CheckCues(const std::vector<CaptionCue>& cues, const std::string& place);

// place: what errors call the text; they name the field.
Result<CaptionBook> ParseCaptions(std::string_view text, const std::string& place);
std::string FormatCaptions(const CaptionBook& book);

}  // namespace lararium::stage
