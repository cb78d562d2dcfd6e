// Errors of the aligner's phoneme boundaries: the recordings are voices of espeak-ng, whose phoneme
// events are withheld. The reference is always the language's plain voice; the recordings have
// other voices, speeds and pitches (klatt2 is another kind of synthesiser), half a second of
// silence before the voice, and noise. Prints a table; fails above 40 ms.
//
//   speech_alignment [--words]    --words: English with pocketsphinx's word times too

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "editor/bake/speech_aligner.h"
#include "editor/bake/speech_words.h"
#include "shared/core/random.h"

namespace lararium::bake {
namespace {

constexpr double kBar = 0.040;   // Largest mean error, seconds.
constexpr double kLead = 0.5;    // Seconds before the voice.
constexpr double kGross = 0.08;  // Seconds; a larger error is in another phoneme.

struct Language {
  const char* name;
  std::vector<const char*> sentences;
};

const std::vector<Language>& Languages() {
  static const std::vector<Language> kLanguages = {
      {"la",
       {"Salvēte, hospitēs! Quid vultis?", "Ecce vīnum, domine. Duo assēs.", "Valē, et redī crās!",
        "Mehercle, bene olet!", "Tōtum diem labōrō.", "Vīnum calidum volō, et pānem.",
        "Quis es tū? Unde venīs?",
        "Arma virumque canō, Trōiae quī prīmus ab ōrīs Ītaliam fātō profugus Lāvīniaque vēnit "
        "lītora."}},
      {"it",
       {"Salute, ospiti! Che cosa volete?", "Ecco il vino, signore. Due assi.",
        "Il pane è ancora caldo!", "Voglio del vino caldo, e del pane.",
        "Chi sei tu? Da dove vieni?", "Il pane l'ha cotto mia madre.",
        "Nel mezzo del cammin di nostra vita mi ritrovai per una selva oscura."}},
      {"en",
       {"Greetings, friends! What will you have?", "Here is your wine, sir. Two asses.",
        "By Hercules, that smells good!", "I want warm wine and some bread.",
        "Who are you? Where do you come from?", "I work all day long.",
        "My mother baked the bread this morning, before the sun came up over the mountain."}}};
  return kLanguages;
}

struct Speaker {
  const char* name;
  VoiceSettings voice;
  double hiss;  // Standard deviation; full scale is 1.
};

const std::vector<Speaker>& Speakers() {
  static const std::vector<Speaker> kSpeakers = {
      {"f3, 130 words/min", {"f3", 60, 50, 130}, 0.002},
      {"m5, 190 words/min", {"m5", 35, 70, 190}, 0.002},
      {"klatt2, 150 words/min", {"klatt2", 50, 50, 150}, 0.002},
      {"m1, 110 words/min, hiss", {"m1", 45, 60, 110}, 0.01}};
  return kSpeakers;
}

Sound Recording(const SpokenText& spoken, double hiss) {
  Sound sound;
  sound.rate = spoken.rate;
  Random random(3);
  const auto add = [&](double sample) {
    sound.samples.push_back(static_cast<float>(sample + hiss * random.Normal()));
  };
  for (int i = 0; i < static_cast<int>(kLead * spoken.rate); ++i) {
    add(0.0);
  }
  for (const int16_t sample : spoken.samples) {
    add(sample / 32768.0);
  }
  return sound;
}

std::vector<Phoneme> Sounds(std::vector<Phoneme> phonemes) {
  std::erase_if(phonemes, [](const Phoneme& phoneme) { return phoneme.ipa.empty(); });
  return phonemes;
}

struct Errors {
  double sum = 0.0;
  int count = 0;
  int gross = 0;
  int failed = 0;  // Number of sentences.

  double mean() const { return sum / std::max(count, 1); }
  void Add(const Errors& other) {
    sum += other.sum;
    count += other.count;
    gross += other.gross;
    failed += other.failed;
  }
};

Errors Measure(const char* language, const char* sentence, const Speaker& speaker, bool words) {
  Errors errors;
  const auto said = Synthesize(sentence, language, speaker.voice);
  const auto reference = Synthesize(sentence, language, {});
  errors.failed = 1;
  if (!said.ok() || !reference.ok()) {
    return errors;
  }
  const Sound recording = Recording(*said, speaker.hiss);
  WordTimes times;
  if (words) {
    auto found = FindEnglishWords(recording, *reference);
    times = found.ok() ? *std::move(found) : WordTimes();
  }
  const auto aligned = AlignSpeech(recording, *reference, times);
  if (!aligned.ok()) {
    return errors;
  }
  const std::vector<Phoneme> truth = Sounds(said->phonemes);
  const std::vector<Phoneme> found = Sounds(*aligned);
  if (truth.size() != found.size()) {
    return errors;
  }
  errors.failed = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    const double error = std::abs(truth[i].begin + kLead - found[i].begin);
    errors.sum += error;
    errors.count += 1;
    errors.gross += error > kGross ? 1 : 0;
  }
  return errors;
}

void Print(const char* language, const char* what, const Errors& errors) {
  std::printf("%-3s %-24s %6.1f ms   %4d boundaries, %d beyond 80 ms%s\n", language, what,
              1000.0 * errors.mean(), errors.count, errors.gross,
              errors.failed > 0 ? ", sentences FAILED" : "");
}

int Run(bool with_words) {
  bool good = true;
  for (const Language& language : Languages()) {
    const bool words = with_words && std::strcmp(language.name, "en") == 0;
    Errors all;
    for (const Speaker& speaker : Speakers()) {
      Errors of_speaker;
      for (const char* sentence : language.sentences) {
        of_speaker.Add(Measure(language.name, sentence, speaker, words));
      }
      Print(language.name, speaker.name, of_speaker);
      all.Add(of_speaker);
    }
    Print(language.name, words ? "all, with word times" : "all", all);
    good = good && all.failed == 0 && all.mean() <= kBar;
  }
  return good ? 0 : 1;
}

}  // namespace
}  // namespace lararium::bake

int main(int argc, char** argv) {
  return lararium::bake::Run(argc > 1 && std::strcmp(argv[1], "--words") == 0);
}
