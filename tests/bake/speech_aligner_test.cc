#include "editor/bake/speech_aligner.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "editor/bake/speech_features.h"
#include "editor/bake/speech_words.h"
#include "shared/core/random.h"

namespace lararium::bake {
namespace {

using ::testing::HasSubstr;

// The synthesis, changed to resemble a recording of another voice, after silence and with hiss.
Sound Recording(const SpokenText& spoken, double lead, double hiss) {
  Sound sound;
  sound.rate = spoken.rate;
  Random random(7);
  const auto add = [&](double sample) {
    sound.samples.push_back(static_cast<float>(sample + hiss * random.Normal()));
  };
  for (int i = 0; i < static_cast<int>(lead * spoken.rate); ++i) {
    add(0.0);
  }
  for (const int16_t sample : spoken.samples) {
    add(sample / 32768.0);
  }
  return sound;
}

std::vector<Phoneme> Sounds(const std::vector<Phoneme>& phonemes) {
  std::vector<Phoneme> sounds = phonemes;
  std::erase_if(sounds, [](const Phoneme& phoneme) { return phoneme.ipa.empty(); });
  return sounds;
}

TEST(Aligner, FindsTheSoundsOfAnotherVoiceAtAnotherPace) {
  constexpr double kLead = 0.4;
  const char* text = "Ecce vīnum, domine. Duo assēs.";
  const auto said = Synthesize(text, "la", {.variant = "f3", .pitch = 65, .rate = 120});
  const auto reference = Synthesize(text, "la", {});
  ASSERT_TRUE(said.ok() && reference.ok());
  const Sound recording = Recording(*said, kLead, 0.003);
  const auto found = AlignSpeech(recording, *reference);
  ASSERT_TRUE(found.ok()) << found.message();
  EXPECT_EQ(found->front().begin, 0.0);
  EXPECT_NEAR(found->back().end, recording.duration(), 1e-9);
  const std::vector<Phoneme> truth = Sounds(said->phonemes);
  const std::vector<Phoneme> sounds = Sounds(*found);
  ASSERT_EQ(sounds.size(), truth.size());
  double error = 0.0;
  for (size_t i = 0; i < truth.size(); ++i) {
    EXPECT_EQ(sounds[i].ipa, truth[i].ipa);
    error += std::abs(sounds[i].begin - truth[i].begin - kLead) / static_cast<double>(truth.size());
  }
  EXPECT_LT(error, 0.030);
}

TEST(Aligner, FindsAPauseThatTheSynthesisHasNot) {
  const auto reference = Synthesize("Tōtum diem labōrō.", "la", {});
  ASSERT_TRUE(reference.ok());
  // Half a second of hiss before the second word.
  const auto second = std::find_if(reference->phonemes.begin(), reference->phonemes.end(),
                                   [](const Phoneme& p) { return p.word == 1; });
  ASSERT_NE(second, reference->phonemes.end());
  Sound recording = Recording(*reference, 0.0, 0.001);
  const auto at = static_cast<std::ptrdiff_t>(second->begin * recording.rate);
  std::vector<float> pause(static_cast<size_t>(recording.rate / 2));
  Random random(9);
  for (float& sample : pause) {
    sample = static_cast<float>(0.001 * random.Normal());
  }
  recording.samples.insert(recording.samples.begin() + at, pause.begin(), pause.end());
  const auto found = AlignSpeech(recording, *reference);
  ASSERT_TRUE(found.ok()) << found.message();
  const auto moved = std::find_if(found->begin(), found->end(),
                                  [](const Phoneme& phoneme) { return phoneme.word == 1; });
  EXPECT_NEAR(moved->begin, second->begin + 0.5, 0.04);
  EXPECT_TRUE((moved - 1)->ipa.empty());
}

TEST(Aligner, RefusesARecordingThatIsTooShort) {
  const auto reference = Synthesize("Vīnum calidum volō, et pānem.", "la", {});
  ASSERT_TRUE(reference.ok());
  Sound recording;
  recording.rate = 16000;
  recording.samples.assign(2000, 0.1f);
  EXPECT_THAT(AlignSpeech(recording, *reference).message(), HasSubstr("too short"));
}

TEST(EnglishWords, AreHeardWhereTheyAre) {
  const char* text = "My mother baked the bread this morning.";
  const auto said = Synthesize(text, "en", {.variant = "m3", .rate = 130});
  ASSERT_TRUE(said.ok());
  const auto words = FindEnglishWords(Recording(*said, 0.3, 0.001), *said);
  if (!words.ok()) {
    GTEST_SKIP() << words.message();
  }
  ASSERT_EQ(words->size(), said->words.size());
  for (size_t i = 0; i < words->size(); ++i) {
    const auto first =
        std::find_if(said->phonemes.begin(), said->phonemes.end(),
                     [i](const Phoneme& phoneme) { return phoneme.word == static_cast<int>(i); });
    ASSERT_TRUE((*words)[i].has_value()) << said->words[i];
    EXPECT_NEAR(*(*words)[i], first->begin + 0.3, 0.09) << said->words[i];
  }
}

TEST(Features, EnergyIsInNepersAndResamplingKeepsATone) {
  std::vector<float> tone;
  for (int i = 0; i < 22050; ++i) {
    tone.push_back(0.5f * std::sin(2.0f * std::numbers::pi_v<float> * 440.0f *
                                   static_cast<float>(i) / 22050.0f));
  }
  const std::vector<Features> frames = ComputeFeatures(tone, 22050);
  EXPECT_EQ(frames.size(), 200u);
  EXPECT_NEAR(frames[100][kEnergy], std::log(0.5 / std::sqrt(2.0)), 0.06);
  EXPECT_LT(frames[100][kChange], 1.0f);
  const std::vector<float> slower = Resample(tone, 22050, 16000);
  EXPECT_EQ(slower.size(), 16000u);
  for (size_t i = 2000; i < 2100; ++i) {
    EXPECT_NEAR(slower[i],
                0.5 * std::sin(2.0 * std::numbers::pi * 440.0 * static_cast<double>(i) / 16000.0),
                2e-3);
  }
}

}  // namespace
}  // namespace lararium::bake
