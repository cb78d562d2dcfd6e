#pragma once

// A line's text as captions: cut where it reads well, shown as long as it takes to read.

#include <span>
#include <string>
#include <vector>

#include "shared/human/face.h"
#include "shared/stage/caption_file.h"

namespace lararium::bake {

struct CaptionRules {
  size_t letters = 42;             // of a row at most, as subtitlers have it
  double seconds = 1.0;            // a caption stays at least
  double letters_per_second = 17;  // read at most
  double reading_on = 4.0;         // seconds that captions may outlast the voice
};

// Characters of UTF-8, accents that combine not counted.
size_t CountLetters(std::string_view text);

// Rows of at most rules.letters where words allow it, as even as they can be and rather
// broken after punctuation.
std::vector<std::string> BreakRows(const std::string& text, const CaptionRules& rules);

// Captions of at most two rows for a text that is said while `visemes` last. They share the
// time by their length and change in a pause of the voice where one is near; the last one
// stays until it can be read. Where there is too much to read they are as long as they are
// said: check says so (ReadingSpeed).
std::vector<stage::CaptionCue> LayOutCaptions(const std::string& text,
                                              const human::VisemeTrack& visemes,
                                              const CaptionRules& rules = {});

// Letters a second of the caption that leaves least time.
double ReadingSpeed(std::span<const stage::CaptionCue> cues);

}  // namespace lararium::bake
