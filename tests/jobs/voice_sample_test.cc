#include "editor/jobs/voice_sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;

CastDocument Named(const std::string& name) {
  CastDocument member;
  member.name = name;
  return member;
}

SpeechDocument SpokenIn(const std::vector<std::string>& languages) {
  SpeechDocument speech;
  speech.spoken = languages;
  return speech;
}

bake::LineTable Lines() {
  bake::LineTable table;
  table.languages = {"it", "la"};
  table.lines = {{"hail", "ben", "", {{"la", "Salve!"}, {"it", "Ciao!"}}},
                 {"ask", "ada", "", {{"la", "Quid vis?"}}},
                 {"answer", "ada", "", {{"la", "Panem."}, {"it", "Il pane."}}}};
  return table;
}

TEST(VoiceSample, IsTheFirstLineInTheLanguageThatIsSpokenFirst) {
  const VoiceSample first = SampleOf(Lines(), SpokenIn({"la", "it"}), Named("ada"));
  EXPECT_EQ(first.text, "Quid vis?");
  EXPECT_EQ(first.language, "la");
  const VoiceSample plain = SampleOf(Lines(), {}, Named("ada"));
  EXPECT_EQ(plain.text, "Il pane.") << "the first language of the table, in which some are silent";
  EXPECT_EQ(plain.language, "it");
}

TEST(VoiceSample, WhoSaysNothingSaysASentenceThatTheLanguageHas) {
  const VoiceSample latin = SampleOf(Lines(), SpokenIn({"la"}), Named("cleo"));
  EXPECT_THAT(latin.text, HasSubstr("Salvēte"));
  EXPECT_EQ(SampleOf({}, SpokenIn({"it-IT"}), Named("cleo")).text,
            SampleOf({}, SpokenIn({"it"}), Named("cleo")).text);
  EXPECT_THAT(SampleOf({}, SpokenIn({"fi"}), Named("cleo")).text, HasSubstr("1, 2, 3"));
  EXPECT_EQ(SampleOf({}, {}, Named("cleo")).language, "en");
}

TEST(VoiceSample, EveryLanguageThatHasNoSentenceCanBeSpokenAllTheSame) {
  for (const char* language : {"la", "it", "en", "de", "fr", "es", "fi"}) {
    const auto sound = SpeakSample(SampleOf({}, SpokenIn({language}), Named("cleo")), {});
    EXPECT_TRUE(sound.ok()) << sound.message();
  }
}

TEST(VoiceSample, AllVariantsThatAreOfferedCanBeSpokenAndDiffer) {
  std::vector<std::vector<std::byte>> sounds;
  for (const std::string& variant : VoiceVariants()) {
    auto sound = SpeakSample({"Salve!", "la"}, {.variant = variant});
    ASSERT_TRUE(sound.ok()) << sound.message();
    EXPECT_EQ(std::find(sounds.begin(), sounds.end(), *sound), sounds.end()) << variant;
    sounds.push_back(*std::move(sound));
  }
}

TEST(VoiceSample, TheLimitsAreThoseThatAVoiceHas) {
  for (const bake::VoiceSettings& good :
       {bake::VoiceSettings{.pitch = 0, .range = 0, .rate = kMinVoiceRate},
        {.pitch = kMaxVoicePitch, .range = kMaxVoicePitch, .rate = kMaxVoiceRate}}) {
    EXPECT_TRUE(good.Validate("voice").ok());
  }
  for (const bake::VoiceSettings& bad : {bake::VoiceSettings{.pitch = kMaxVoicePitch + 1},
                                         {.range = kMaxVoicePitch + 1},
                                         {.rate = kMinVoiceRate - 1},
                                         {.rate = kMaxVoiceRate + 1}}) {
    EXPECT_FALSE(bad.Validate("voice").ok());
  }
}

// Half a second of a tone.
bake::Sound Tone() {
  bake::Sound sound;
  sound.rate = 22050;
  for (int i = 0; i < sound.rate / 2; ++i) {
    sound.samples.push_back(0.5f * std::sin(0.1f * static_cast<float>(i)));
  }
  return sound;
}

TEST(PlaySound, PlaysAllOfItAndSilenceBehind) {
  const test::TemporaryFolder folder;
  auto out = audio::CreateAudioOut(audio::AudioOutKind::kFile, folder / "heard.wav");
  ASSERT_TRUE(out.ok()) << out.message();
  NoProgress progress;
  ASSERT_TRUE(PlaySound(Tone(), **out, progress).ok());
  const auto heard = bake::ReadSound(folder / "heard.wav");
  ASSERT_TRUE(heard.ok()) << heard.message();
  EXPECT_EQ(heard->rate, 48000);
  EXPECT_GE(heard->duration(), 0.9);
  EXPECT_LT(heard->duration(), 1.0);
  const auto loudest = [&](size_t from, size_t to) {
    float most = 0.0f;
    for (size_t i = from; i < to; ++i) {
      most = std::max(most, std::abs(heard->samples[i]));
    }
    return most;
  };
  EXPECT_NEAR(loudest(22'000, 23'500), 0.5f, 0.02f) << "just before the tone ends";
  EXPECT_LT(loudest(24'500, heard->samples.size()), 1e-3f);
}

TEST(PlaySound, StopsWhereItIsCancelled) {
  class Impatient : public Progress {
   public:
    void Report(std::string_view, double) override { ++blocks; }
    bool Cancelled() const override { return blocks >= 3; }
    int blocks = 0;
  };
  class Counting : public audio::AudioOut {
   public:
    Status Write(std::span<const float> stereo) override {
      frames += stereo.size() / 2;
      return Status();
    }
    double latency() const override { return 0.0; }
    Status Finish() override { return Status(); }
    std::string name() const override { return "counting"; }
    size_t frames = 0;
  };
  Impatient progress;
  Counting out;
  EXPECT_FALSE(PlaySound(Tone(), out, progress).ok());
  EXPECT_EQ(progress.blocks, 3);
  EXPECT_LT(out.frames, size_t{24'000} / 2);
}

}  // namespace
}  // namespace lararium::editor
