#pragma once

// A line of a drama as people hear it and mouths move for it.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "editor/bake/speech_synthesis.h"
#include "shared/core/status.h"
#include "shared/human/face.h"

namespace lararium::bake {

struct SpeechSource {
  std::string text;
  std::string language;  // of the text, as espeak-ng calls it: la, it, en, ...
  VoiceSettings voice;
  std::filesystem::path recording = {};  // of the line; empty: it is synthesised
};

// ID.wav, .flac, .ogg or .opus in a folder; nothing where there is none. Two are an error.
Result<std::optional<std::filesystem::path>> FindRecording(const std::filesystem::path& folder,
                                                           const std::string& id);

// FLAC. Deterministic. Synthesised voices are made equally loud; recordings stay as they are.
Result<std::vector<std::byte>> BakeSound(const SpeechSource& source);

// From the same beginning as the sound, and as long: from what the synthesis said, or by
// finding the text's sounds in the recording (speech_aligner.h), in English with the help of
// its words (speech_words.h). Adds warnings.
Result<human::VisemeTrack> BakeVisemes(const SpeechSource& source,
                                       std::vector<std::string>& warnings);

}  // namespace lararium::bake
