#pragma once

// What somebody's voice sounds like, to be judged by ear.

#include <cstddef>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "editor/bake/line_table.h"
#include "editor/bake/speech_sound.h"
#include "shared/audio/audio_out.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::app {

// Within which a voice can be set; see bake::VoiceSettings.
inline constexpr int kMaxVoicePitch = 99;  // of the range too
inline constexpr int kMinVoiceRate = 80;   // words a minute
inline constexpr int kMaxVoiceRate = 450;

// The voices that espeak-ng has beside the plain one of a language: of men, then of women.
std::vector<std::string> VoiceVariants();

struct VoiceSample {
  std::string text;
  std::string language;  // of the text, as espeak-ng calls it
};

// The first line that somebody has in the language that is spoken first; where they have none, a
// sentence in that language.
VoiceSample SampleOf(const bake::LineTable& lines,
                     const SpeechDocument& speech,
                     const CastDocument& member);

// FLAC, as loud as the drama has it. Takes a second or two.
Result<std::vector<std::byte>> SpeakSample(const VoiceSample& sample,
                                           const bake::VoiceSettings& voice);

// Plays a sound on both sides, to its end or until that is cancelled.
Status PlaySound(const bake::Sound& sound, audio::AudioOut& out, Progress& progress);

// Speaks and plays a sample on the sound device. Fails where there is none.
Status PlaySample(const VoiceSample& sample, const bake::VoiceSettings& voice, Progress& progress);

}  // namespace lararium::app
