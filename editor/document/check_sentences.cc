#include "editor/document/check_sentences.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "editor/text/text.h"

namespace lararium::editor {

void Append(std::vector<Sentence> more, std::vector<Sentence>& sentences) {
  std::move(more.begin(), more.end(), std::back_inserter(sentences));
}

std::string SecondsText(double seconds) { return Text("%.2f s", seconds); }

Sentence AtPlace(Sentence where, Sentence what) {
  return Sentence("%s: %s", {std::move(where), std::move(what)});
}

Sentence AtTime(Sentence what, double seconds) {
  return Sentence("%s (at %s)", {std::move(what), SecondsText(seconds)});
}

}  // namespace lararium::editor
