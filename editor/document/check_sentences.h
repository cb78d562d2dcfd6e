#pragma once

// Sentences that say where and when a check found a problem. Code that extracts the location
// (editor/panels/dialogs/problem_place.h) parses the English text.

#include <string>
#include <vector>

#include "shared/core/sentence.h"

namespace lararium::editor {

void Append(std::vector<Sentence> more, std::vector<Sentence>& sentences);

// "3.20 s"
std::string SecondsText(double seconds);

// "drama.lua:12: what"
Sentence AtPlace(Sentence where, Sentence what);

// "what (at 3.20 s)"; the time is that of the drama.
Sentence AtTime(Sentence what, double seconds);

}  // namespace lararium::editor
