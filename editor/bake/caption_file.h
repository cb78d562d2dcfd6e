#pragma once

// Reads and writes the caption files of other programs: SubRip (.srt) and WebVTT (.vtt).

#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/stage/caption_file.h"

namespace lararium::bake {

struct FileCue {
  std::string id;      // The identifier in WebVTT, the number in SubRip.
  double begin = 0.0;  // seconds
  double end = 0.0;
  std::string text;  // UTF-8, rows separated by '\n', no style tags, never empty.

  friend bool operator==(const FileCue&, const FileCue&) = default;
};

struct CaptionFile {
  std::vector<FileCue> cues;  // The order is that of the file.
  // What was left out or guessed: "line 12: the caption ends before it begins; it was left out".
  std::vector<std::string> notes;
};

// Reads a file in any encoding (editor/text/foreign_text.h). "WEBVTT" in the first row makes it
// WebVTT. Both formats are read as leniently as players do: a row with two times begins a caption;
// blank rows, numbers and identifiers may stand around it. Removes tags (<i>, <c.x>, {\an8}) and
// decodes entities. A caption that cannot be read costs that caption, with a note; a file without
// any that can be read is an error. Errors name the text as `where`, and the line.
Result<CaptionFile> ParseCaptionFile(std::string_view text, const std::string& where);

// The captions as a show has them: in order of time, without overlap, at most two rows each.
// Captions that the file shows at the same time share the rows.
std::vector<stage::CaptionCue> ShownCues(std::vector<FileCue> cues);

std::string FormatSrt(const std::vector<FileCue>& cues);  // Numbers the cues from 1.
std::string FormatVtt(const std::vector<FileCue>& cues);

}  // namespace lararium::bake
