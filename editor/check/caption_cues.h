#pragma once

// Converts between the captions of a complete drama, as other programs use them, and those of
// its lines.

#include <map>
#include <string>
#include <vector>

#include "editor/bake/caption_file.h"
#include "editor/check/line_checks.h"
#include "shared/stage/caption_file.h"

namespace lararium::editor {

// The captions of all lines said, in one language and in the time of the drama. A cue ends when
// the next begins, because programs that read these files show one at a time. Lines without
// captions are skipped.
std::vector<bake::FileCue> CuesOf(const std::vector<SaidLine>& said,
                                  const stage::CaptionBook& book,
                                  const std::string& language);

// The inverse: for each line, its cues at the first time that it is said, in its own time. Adds
// a warning for each cue without a line.
std::map<std::string, std::vector<bake::FileCue>> CuesByLine(std::vector<bake::FileCue> cues,
                                                             const std::vector<SaidLine>& said,
                                                             std::vector<std::string>& warnings);

}  // namespace lararium::editor
