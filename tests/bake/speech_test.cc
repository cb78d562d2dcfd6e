#include "editor/bake/speech.h"

#include <gmock/gmock.h>
#include <libintl.h>

#include <cmath>
#include <shared_mutex>
#include <thread>

#include "editor/bake/speech_sound.h"
#include "editor/bake/speech_visemes.h"
#include "shared/core/fork.h"

namespace lararium::bake {
namespace {

using human::Viseme;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<Viseme> Shown(const human::VisemeTrack& track) {
  std::vector<Viseme> visemes;
  for (const auto& key : track.keys) {
    visemes.push_back(key.viseme);
  }
  return visemes;
}

// Translation holds locks of the C library that the process of the engine needs.
TEST(Synthesis, AnswersWhileTextsAreTranslated) {
  std::jthread translates([](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      const std::shared_lock gate(ForkGate());
      dgettext("lararium", "a text");
    }
  });
  for (int i = 0; i < 20; ++i) {
    const auto spoken = Synthesize("ave", "la", {});
    ASSERT_TRUE(spoken.ok()) << spoken.message();
  }
}

TEST(Synthesis, PhonemesFillTheSoundWithoutGapsInEachLanguage) {
  const std::pair<const char*, const char*> sentences[] = {
      {"la", "Salvēte, hospitēs! Quid vultis?"},
      {"it", "Ecco il vino, signore. Due assi."},
      {"en", "Here is your wine, sir. Two asses."}};
  for (const auto& [language, text] : sentences) {
    const auto spoken = Synthesize(text, language, {});
    ASSERT_TRUE(spoken.ok()) << spoken.message();
    EXPECT_GT(spoken->duration(), 1.0);
    ASSERT_GT(spoken->phonemes.size(), 10u);
    double end = 0.0;
    for (const Phoneme& phoneme : spoken->phonemes) {
      EXPECT_EQ(phoneme.begin, end);
      EXPECT_GT(phoneme.end, phoneme.begin);
      end = phoneme.end;
    }
    EXPECT_NEAR(end, spoken->duration(), 1e-9);
    EXPECT_TRUE(spoken->phonemes.back().ipa.empty()) << "it ends in a pause";
  }
}

TEST(Synthesis, WordsAreThoseOfTheText) {
  const auto spoken = Synthesize("Grātiās tibi agō.", "la", {});
  ASSERT_TRUE(spoken.ok()) << spoken.message();
  EXPECT_THAT(spoken->words, ElementsAre("Grātiās", "tibi", "agō"));
  EXPECT_EQ(spoken->phonemes.front().word, 0);
}

TEST(Synthesis, SaysWhatItCannot) {
  EXPECT_THAT(Synthesize("a", "qqq", {}).message(), HasSubstr("does not speak"));
  EXPECT_THAT(Synthesize("a", "la", {.variant = "nobody7"}).message(), HasSubstr("no voice"));
  EXPECT_THAT(Synthesize("a", "la", {.rate = 7}).message(), HasSubstr("rate"));
  EXPECT_THAT(Synthesize("...", "la", {}).message(), HasSubstr("nothing to say"));
}

TEST(BakeSound, IsTheSameEveryTimeAndAsLongAsItsVisemes) {
  const SpeechSource source = {"Valē, et redī crās!", "la", {.variant = "m3", .rate = 130}};
  const auto sound = BakeSound(source);
  ASSERT_TRUE(sound.ok()) << sound.message();
  ASSERT_TRUE(BakeSound({"Salvēte!", "la", {}}).ok()) << "another voice in between";
  EXPECT_EQ(*BakeSound(source), *sound);
  const auto read = ReadSound(*sound, "vale.flac");
  ASSERT_TRUE(read.ok()) << read.message();
  std::vector<std::string> warnings;
  const auto visemes = BakeVisemes(source, warnings);
  ASSERT_TRUE(visemes.ok());
  EXPECT_NEAR(visemes->duration, read->duration(), 1e-4);
  EXPECT_TRUE(visemes->Validate("vale").ok());
}

TEST(Sound, FlacKeepsSamplesToSixteenBits) {
  Sound sound;
  sound.rate = 24000;
  for (int i = 0; i < 5000; ++i) {
    sound.samples.push_back(0.5f * std::sin(0.05f * static_cast<float>(i)));
  }
  const auto flac = WriteFlac(sound);
  ASSERT_TRUE(flac.ok());
  EXPECT_LT(flac->size(), 2 * sound.samples.size());
  const auto read = ReadSound(*flac, "sine.flac");
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(read->rate, sound.rate);
  ASSERT_EQ(read->samples.size(), sound.samples.size());
  for (size_t i = 0; i < sound.samples.size(); ++i) {
    ASSERT_NEAR(read->samples[i], sound.samples[i], 1.0f / 16384.0f);
  }
  const std::vector<std::byte> half(flac->begin(), flac->begin() + 30);
  EXPECT_FALSE(ReadSound(half, "half.flac").ok());
}

TEST(Sound, NormalizedVoicesAreEquallyLoud) {
  Sound quiet;
  quiet.rate = 8000;
  for (int i = 0; i < 8000; ++i) {  // Half of the sound is a pause.
    quiet.samples.push_back(i < 4000 ? 0.01f * std::sin(0.3f * static_cast<float>(i)) : 0.0f);
  }
  Normalize(quiet);
  double power = 0.0;
  for (const float sample : quiet.samples) {
    power += static_cast<double>(sample) * static_cast<double>(sample);
  }
  EXPECT_NEAR(std::sqrt(power / 4000.0), 0.1, 0.005);
}

TEST(Visemes, FollowPlaceAndMannerOfSounds) {
  const std::vector<Phoneme> phonemes = {
      {"h", 0.0, 0.05, 0}, {"aɪ", 0.05, 0.25, 0}, {"tʃ", 0.25, 0.35, 0}, {"eː", 0.35, 0.5, 0},
      {"ɛ", 0.5, 0.55, 1}, {"", 0.55, 0.8, -1},   {"b", 0.8, 0.9, 1},    {"uː", 0.9, 1.0, 1}};
  const human::VisemeTrack track = VisemesOf(phonemes, 1.1);
  EXPECT_THAT(Shown(track), ElementsAre(Viseme::kAa, Viseme::kIh, Viseme::kCH, Viseme::kE,
                                        Viseme::kSil, Viseme::kPP, Viseme::kOu));
  EXPECT_NEAR(track.keys[1].time, 0.15f, 1e-6f) << "the second half of the diphthong";
  EXPECT_FLOAT_EQ(track.duration, 1.1f);
  EXPECT_TRUE(track.Validate("track").ok());
}

TEST(Visemes, EverySoundOfTheLanguagesHasAShapeOfItsOwn) {
  for (const auto& [language, text] : std::vector<std::pair<std::string, std::string>>{
           {"la", "Quis hanc villam rūsticam aedificāvit? Iūppiter, exaudī nōs! Zephyrus flat."},
           {"it", "Gli zii sciocchi guardano ogni pezzo di ghiaccio nel giardino."},
           {"en", "The quick judge thought each vision pleasing, but the boys would not go."}}) {
    const auto spoken = Synthesize(text, language, {});
    ASSERT_TRUE(spoken.ok()) << spoken.message();
    for (const Phoneme& phoneme : spoken->phonemes) {
      const human::VisemeTrack track = VisemesOf(std::span(&phoneme, 1), 10.0);
      ASSERT_FALSE(track.keys.empty());
      const bool breath = phoneme.ipa == "h" || phoneme.ipa == "ʔ" || phoneme.ipa == "ʰ";
      EXPECT_TRUE(breath || track.keys[0].strength != 0.5f) << language << " " << phoneme.ipa;
    }
  }
}

}  // namespace
}  // namespace lararium::bake
