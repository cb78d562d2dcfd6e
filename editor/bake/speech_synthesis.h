#pragma once

// Speech from text by espeak-ng, with what it says when.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::bake {

// Somebody's voice. espeak-ng's own scales.
struct VoiceSettings {
  std::string variant = {};  // "m3", "f2", ... of espeak-ng; empty: the language's plain voice
  int pitch = 50;            // 0..99
  int range = 50;            // of the pitch: 0 monotone .. 99
  int rate = 150;            // words a minute, 80..450

  Status Validate(const std::string& place) const;

  friend bool operator==(const VoiceSettings&, const VoiceSettings&) = default;
};

// One sound of a language, or a pause.
struct Phoneme {
  std::string ipa;     // UTF-8, as espeak-ng writes it ("eː", "tʃ", "aɪ"); empty: a pause
  double begin = 0.0;  // seconds
  double end = 0.0;
  int word = -1;  // index of the word it belongs to, of those with a sound; -1: a pause
};

struct SpokenText {
  int rate = 0;                    // samples a second
  std::vector<int16_t> samples;    // mono
  std::vector<Phoneme> phonemes;   // without gaps, from 0 to the end of the samples
  std::vector<std::string> words;  // as the text has them

  double duration() const { return rate > 0 ? static_cast<double>(samples.size()) / rate : 0.0; }
};

// Deterministic: the same text, language and voice give the same samples. Fails where
// espeak-ng has no such language or variant, and where there is nothing to say.
// espeak-ng runs in a child process of its own each time: it keeps state between texts.
Result<SpokenText> Synthesize(const std::string& text,
                              const std::string& language,
                              const VoiceSettings& voice);

// The synthesiser, its version and licence: "eSpeak NG 1.51; GPL-3.0-or-later".
std::string SynthesizerCredits();

}  // namespace lararium::bake
