#pragma once

// Bakes the sound of a line and the mouth shapes that belong to it.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "editor/bake/speech_synthesis.h"
#include "shared/core/status.h"
#include "shared/human/face.h"

namespace lararium::bake {

struct SpeechSource {
  std::string text;
  std::string language;  // Language of the text as espeak-ng names it: la, it, en, ...
  VoiceSettings voice;
  std::filesystem::path recording = {};  // Recording of the line; empty if it is synthesised.
};

// Gives a FLAC file. Deterministic. Normalises the loudness of synthesised voices; recordings
// keep theirs.
Result<std::vector<std::byte>> BakeSound(const SpeechSource& source);

// Gives a track with the beginning and duration of the sound. The timing comes from the
// synthesiser or, for a recording, from aligning the text with it (speech_aligner.h), in
// English with the help of its words (speech_words.h). Appends to `warnings`.
Result<human::VisemeTrack> BakeVisemes(const SpeechSource& source,
                                       std::vector<std::string>& warnings);

}  // namespace lararium::bake
