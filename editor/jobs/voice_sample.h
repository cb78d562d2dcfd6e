#pragma once

// Samples of synthesised voices, for users to listen to.

#include <cstddef>
#include <string>
#include <vector>

#include "editor/bake/line_table.h"
#include "editor/bake/speech_sound.h"
#include "editor/document/project.h"
#include "shared/audio/audio_out.h"
#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// Limits of bake::VoiceSettings.
inline constexpr int kMaxVoicePitch = 99;  // Also the limit of the pitch range.
inline constexpr int kMinVoiceRate = 80;   // Words a minute.
inline constexpr int kMaxVoiceRate = 450;

// The variants of espeak-ng besides a language's plain voice: male, then female.
std::vector<std::string> VoiceVariants();

struct VoiceSample {
  std::string text;
  std::string language;  // The language of the text in the notation of espeak-ng.
};

// The first line of a member in the first spoken language; where the member has none, a standard
// sentence in that language.
VoiceSample SampleOf(const bake::LineTable& lines,
                     const SpeechDocument& speech,
                     const CastDocument& member);

// FLAC, as loud as in the drama. Takes a second or two.
Result<std::vector<std::byte>> SpeakSample(const VoiceSample& sample,
                                           const bake::VoiceSettings& voice);

// Plays a sound on both channels, until its end or until it is cancelled.
Status PlaySound(const bake::Sound& sound, audio::AudioOut& out, Progress& progress);

// Synthesises a sample and plays it on the sound device. Fails where there is no device.
Status PlaySample(const VoiceSample& sample, const bake::VoiceSettings& voice, Progress& progress);

}  // namespace lararium::editor
