#pragma once

// Splits the text of a line into captions at good points and times them so that they can be
// read.

#include <span>
#include <string>
#include <vector>

#include "shared/human/face.h"
#include "shared/stage/caption_file.h"

namespace lararium::bake {

struct CaptionRules {
  size_t letters = 42;             // Letters in a row at most, as is usual in subtitling.
  double seconds = 1.0;            // The shortest time that a caption stays, in seconds.
  double letters_per_second = 17;  // The highest reading speed.
  double reading_on = 4.0;         // Seconds that captions may stay after the voice ends.
};

// Counts the characters of UTF-8 text without combining accents.
size_t CountLetters(std::string_view text);

// Breaks a text into rows of at most `rules.letters` if the words allow it, as equal in length
// as possible, preferably after punctuation.
std::vector<std::string> BreakRows(const std::string& text, const CaptionRules& rules);

// Divides a text into captions of at most two rows for a voice that lasts as long as `visemes`.
// Each caption gets a share of the time in proportion to its length, and changes in a pause of
// the voice if one is near; the last one stays until it can be read. If there is too much to
// read, captions last as long as the voice, and the project check reports it (ReadingSpeed).
std::vector<stage::CaptionCue> LayOutCaptions(const std::string& text,
                                              const human::VisemeTrack& visemes,
                                              const CaptionRules& rules = {});

// Letters per second of the caption that leaves the least time to read.
double ReadingSpeed(std::span<const stage::CaptionCue> cues);

}  // namespace lararium::bake
