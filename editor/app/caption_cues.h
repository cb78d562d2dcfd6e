#pragma once

// Captions of a whole drama, as other programs show and write them, and those of its lines.

#include <map>
#include <string>
#include <vector>

#include "editor/app/line_checks.h"
#include "editor/bake/caption_file.h"
#include "shared/stage/caption_file.h"

namespace lararium::app {

// The captions of all that was said, in a language, by the drama's time. One is gone when the
// next begins, as readers of these files show one at a time. Lines without captions are passed
// over.
std::vector<bake::FileCue> CuesOf(const std::vector<SaidLine>& said,
                                  const stage::CaptionBook& book,
                                  const std::string& language);

// The way back: the cues of each line when it is said for the first time, by its own time. A cue
// that belongs to no line is told in warnings.
std::map<std::string, std::vector<bake::FileCue>> CuesByLine(const std::vector<bake::FileCue>& cues,
                                                             const std::vector<SaidLine>& said,
                                                             std::vector<std::string>& warnings);

}  // namespace lararium::app
