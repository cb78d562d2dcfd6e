#include "editor/bake/speech.h"

#include "editor/bake/recording.h"
#include "editor/bake/speech_aligner.h"
#include "editor/bake/speech_features.h"
#include "editor/bake/speech_sound.h"
#include "editor/bake/speech_visemes.h"
#include "editor/bake/speech_words.h"

namespace lararium::bake {
namespace {

Sound SoundOf(const SpokenText& spoken) {
  Sound sound;
  sound.rate = spoken.rate;
  sound.samples.reserve(spoken.samples.size());
  for (const int16_t sample : spoken.samples) {
    sound.samples.push_back(static_cast<float>(sample) / 32768.0f);
  }
  return sound;
}

constexpr int kHighestPlaybackRate = 48'000;  // Highest sample rate for playback.

Result<std::vector<std::byte>> BakeRecording(const std::filesystem::path& file) {
  LARARIUM_ASSIGN_OR_RETURN(Sound sound, ReadSound(file));
  if (sound.rate > kHighestPlaybackRate) {
    sound.samples = Resample(sound.samples, sound.rate, kHighestPlaybackRate);
    sound.rate = kHighestPlaybackRate;
  }
  return WriteFlac(sound);
}

bool IsEnglish(const std::string& language) {
  return language == "en" || language.starts_with("en-");
}

Result<human::VisemeTrack> AlignRecording(const SpeechSource& source,
                                          std::vector<std::string>& warnings) {
  LARARIUM_ASSIGN_OR_RETURN(const Sound recording, ReadRecording(source.recording, warnings));
  LARARIUM_ASSIGN_OR_RETURN(const SpokenText reference,
                            Synthesize(source.text, source.language, source.voice));
  WordTimes words;
  if (IsEnglish(source.language)) {
    Result<WordTimes> found = FindEnglishWords(recording, reference);
    if (found.ok()) {
      words = *std::move(found);
    } else {
      warnings.push_back(source.recording.string() + ": " + found.message());
    }
  }
  const Result<std::vector<Phoneme>> phonemes = AlignSpeech(recording, reference, words);
  if (!phonemes.ok()) {
    return phonemes.status().At(source.recording.string());
  }
  return VisemesOf(*phonemes, recording.duration());
}

}  // namespace

Result<std::vector<std::byte>> BakeSound(const SpeechSource& source) {
  if (!source.recording.empty()) {
    return BakeRecording(source.recording);
  }
  LARARIUM_ASSIGN_OR_RETURN(const SpokenText spoken,
                            Synthesize(source.text, source.language, source.voice));
  Sound sound = SoundOf(spoken);
  Normalize(sound);
  return WriteFlac(sound);
}

Result<human::VisemeTrack> BakeVisemes(const SpeechSource& source,
                                       std::vector<std::string>& warnings) {
  if (!source.recording.empty()) {
    return AlignRecording(source, warnings);
  }
  LARARIUM_ASSIGN_OR_RETURN(const SpokenText spoken,
                            Synthesize(source.text, source.language, source.voice));
  return VisemesOf(spoken.phonemes, spoken.duration());
}

}  // namespace lararium::bake
