#include "editor/jobs/voice_sample.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "editor/bake/speech.h"
#include "editor/bake/speech_features.h"

namespace lararium::editor {
namespace {

constexpr int kRate = 48'000;    // The rate of audio::AudioOut.
constexpr size_t kBlock = 2400;  // Frames; a device buffers four blocks.
// Frames of silence behind the end, because a device drops what it has not played yet.
constexpr size_t kSilence = 19200;

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kSentences = {{
    {"la", "Salvēte, hospitēs! Quid vultis hodiē?"},
    {"it", "Benvenuti! Che cosa desiderate oggi?"},
    {"en", "Welcome, friends! What would you like today?"},
    {"de", "Willkommen, Freunde! Was darf es heute sein?"},
    {"fr", "Bienvenue, mes amis ! Que désirez-vous aujourd'hui ?"},
    {"es", "¡Bienvenidos, amigos! ¿Qué desean hoy?"},
}};
constexpr std::string_view kNumbers = "1, 2, 3, 4, 5.";  // Numbers exist in every language.

std::string SentenceIn(const std::string& language) {
  const std::string_view stem = std::string_view(language).substr(0, language.find('-'));
  const auto known = std::find_if(kSentences.begin(), kSentences.end(),
                                  [&](const auto& entry) { return entry.first == stem; });
  return std::string(known != kSentences.end() ? known->second : kNumbers);
}

std::string FirstLanguage(const bake::LineTable& lines, const SpeechDocument& speech) {
  if (!speech.spoken.empty()) {
    return speech.spoken.front();
  }
  return lines.languages.empty() ? "en" : lines.languages.front();
}

}  // namespace

std::vector<std::string> VoiceVariants() {
  return {"m1", "m2", "m3", "m4", "m5", "m6", "m7", "m8", "f1", "f2", "f3", "f4", "f5"};
}

VoiceSample SampleOf(const bake::LineTable& lines,
                     const SpeechDocument& speech,
                     const CastDocument& member) {
  const std::string language = FirstLanguage(lines, speech);
  for (const bake::Line& line : lines.lines) {
    const auto text = line.text.find(language);
    if (line.speaker == member.name && text != line.text.end() && !text->second.empty()) {
      return {text->second, language};
    }
  }
  return {SentenceIn(language), language};
}

Result<std::vector<std::byte>> SpeakSample(const VoiceSample& sample,
                                           const bake::VoiceSettings& voice) {
  return bake::BakeSound({sample.text, sample.language, voice});
}

Status PlaySound(const bake::Sound& sound, audio::AudioOut& out, Progress& progress) {
  std::vector<float> mono = bake::Resample(sound.samples, sound.rate, kRate);
  mono.resize((mono.size() + kSilence + kBlock - 1) / kBlock * kBlock);
  std::vector<float> stereo(2 * kBlock);
  for (size_t at = 0; at < mono.size(); at += kBlock) {
    if (progress.Cancelled()) {
      return Status::Error("the voice", "was cut short");
    }
    for (size_t i = 0; i < kBlock; ++i) {
      stereo[2 * i] = stereo[2 * i + 1] = mono[at + i];
    }
    LARARIUM_RETURN_IF_ERROR(out.Write(stereo));
    progress.Report("speaking",
                    static_cast<double>(at + kBlock) / static_cast<double>(mono.size()));
  }
  return out.Finish();
}

Status PlaySample(const VoiceSample& sample, const bake::VoiceSettings& voice, Progress& progress) {
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes, SpeakSample(sample, voice));
  LARARIUM_ASSIGN_OR_RETURN(const bake::Sound sound, bake::ReadSound(bytes, "the voice"));
  const auto out = audio::CreateAudioOut(audio::AudioOutKind::kDevice);
  if (!out.ok()) {
    return Status::Error("the voice", "cannot be heard: there is no sound device",
                         "connect one and listen again");
  }
  return PlaySound(sound, **out, progress);
}

}  // namespace lararium::editor
