#pragma once

// How checks say where and when something is wrong. Whoever reads checks for their places
// (editor/panels/problem_place.h) reads the English.

#include <string>
#include <vector>

#include "shared/core/sentence.h"

namespace lararium::app {

void Append(std::vector<Sentence> more, std::vector<Sentence>& sentences);

// "3.20 s"
std::string SecondsText(double seconds);

// "drama.lua:12: what"
Sentence AtPlace(Sentence where, Sentence what);

// "what (at 3.20 s)", of the drama.
Sentence AtTime(Sentence what, double seconds);

}  // namespace lararium::app
