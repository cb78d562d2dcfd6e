#pragma once

// Synthesises speech with espeak-ng and reports when each sound is said.

#include <cstdint>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

// Settings of a voice in the scales of espeak-ng.
struct VoiceSettings {
  // Variant of espeak-ng ("m3", "f2", ...); empty for the plain voice of the language.
  std::string variant = {};
  int pitch = 50;  // 0..99
  int range = 50;  // Range of the pitch, from 0 (monotone) to 99.
  int rate = 150;  // Words per minute, 80..450.

  Status Validate(const std::string& where) const;

  friend bool operator==(const VoiceSettings&, const VoiceSettings&) = default;
};

// One sound of a language, or a pause.
struct Phoneme {
  std::string ipa;     // UTF-8 as espeak-ng writes it ("eː", "tʃ", "aɪ"); empty for a pause.
  double begin = 0.0;  // seconds
  double end = 0.0;
  int word = -1;  // Index of its word among the words with a sound; -1 for a pause.
};

struct SpokenText {
  int rate = 0;                    // Samples per second.
  std::vector<int16_t> samples;    // Mono.
  std::vector<Phoneme> phonemes;   // Contiguous from 0 to the end of the samples.
  std::vector<std::string> words;  // The words as written in the text.

  double duration() const { return rate > 0 ? static_cast<double>(samples.size()) / rate : 0.0; }
};

// Deterministic: the same text, language and voice give the same samples. Fails if espeak-ng
// lacks the language or variant, or if there is nothing to say. Runs espeak-ng in a new child
// process each time, because it keeps state between texts.
Result<SpokenText> Synthesize(const std::string& text,
                              const std::string& language,
                              const VoiceSettings& voice);

// Name, version and licence of the synthesiser: "eSpeak NG 1.51; GPL-3.0-or-later".
std::string SynthesizerCredits();

}  // namespace lararium::bake
