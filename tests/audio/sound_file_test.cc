#include "shared/audio/sound_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/audio/test_sounds.h"

namespace lararium::audio {
namespace {

using test::Coding;
using ::testing::HasSubstr;

std::vector<int16_t> ReadAll(SoundReader& reader) {
  std::vector<int16_t> samples(static_cast<size_t>(reader.frames() * reader.channels()));
  EXPECT_EQ(reader.Read(samples), static_cast<size_t>(reader.frames()));
  return samples;
}

TEST(SoundReader, ReadsLosslessFilesExactly) {
  const std::vector<float> noise = test::Noise(0.5);
  for (const Coding coding : {Coding::kWav, Coding::kFlac}) {
    const auto bytes = test::Encode(noise, 1, 44'100, coding);
    auto reader = SoundReader::Open(bytes, "noise");
    ASSERT_TRUE(reader.ok()) << reader.message();
    EXPECT_EQ(reader->rate(), 44'100);
    EXPECT_EQ(reader->channels(), 1);
    const std::vector<int16_t> samples = ReadAll(*reader);
    ASSERT_EQ(samples.size(), noise.size());
    for (size_t i = 0; i < noise.size(); ++i) {
      ASSERT_NEAR(samples[i], noise[i] * 32768.0f, 1.01) << i;
    }
  }
}

TEST(SoundReader, ReadsVorbisAndOpusNearly) {
  const std::vector<float> tone = test::Tone(0.5, 440.0);
  for (const Coding coding : {Coding::kVorbis, Coding::kOpus}) {
    const auto bytes = test::Encode(tone, 1, test::kRate, coding);
    auto reader = SoundReader::Open(bytes, "tone");
    ASSERT_TRUE(reader.ok()) << reader.message();
    ASSERT_EQ(reader->frames(), static_cast<int64_t>(tone.size()));
    const std::vector<int16_t> samples = ReadAll(*reader);
    double error = 0.0;
    for (size_t i = 0; i < tone.size(); ++i) {
      error += std::pow(samples[i] / 32768.0 - static_cast<double>(tone[i]), 2.0);
    }
    EXPECT_LT(std::sqrt(error / static_cast<double>(tone.size())), 0.02);
  }
}

TEST(SoundReader, GoesToTheExactFrame) {
  const std::vector<float> noise = test::Noise(1.0);
  for (const Coding coding : {Coding::kWav, Coding::kFlac}) {
    const auto bytes = test::Encode(noise, 2, test::kRate, coding);
    auto reader = SoundReader::Open(bytes, "noise");
    ASSERT_TRUE(reader.ok());
    const std::vector<int16_t> all = ReadAll(*reader);
    for (const int64_t frame : {0, 1, 4095, 12'345, 23'990}) {
      ASSERT_TRUE(reader->Seek(frame));
      std::vector<int16_t> some(16);
      ASSERT_EQ(reader->Read(some), 8u);
      EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin() + 2 * frame)) << frame;
    }
  }
}

TEST(SoundReader, RefusesWhatIsNoSound) {
  const char* texts[] = {"",    "This is a letter.", "OggS", "RIFF1234WAVE", "RIFFxxxxAVI LIST",
                         "fLaC"};
  for (const char* text : texts) {
    const auto bytes = std::as_bytes(std::span(text, std::strlen(text)));
    const auto reader = SoundReader::Open(bytes, "voice.opus");
    ASSERT_FALSE(reader.ok()) << text;
    EXPECT_THAT(reader.message(), HasSubstr("voice.opus: "));
    EXPECT_THAT(reader.message(), HasSubstr("give WAV, FLAC"));
  }
}

TEST(SoundReader, RefusesOddRatesAndChannels) {
  const std::vector<float> noise = test::Noise(0.1);
  EXPECT_THAT(SoundReader::Open(test::Encode(noise, 6), "a").message(), HasSubstr("6 channels"));
  EXPECT_THAT(SoundReader::Open(test::Encode(noise, 1, 4'000), "a").message(),
              HasSubstr("4000 samples a second"));
}

TEST(SoundReader, CutOffFilesGiveLessOrAnError) {
  const std::vector<float> noise = test::Noise(1.0);
  for (const Coding coding : {Coding::kWav, Coding::kFlac, Coding::kVorbis, Coding::kOpus}) {
    const auto bytes = test::Encode(noise, 1, test::kRate, coding);
    for (const double part : {0.001, 0.01, 0.5, 0.99}) {
      const auto cut =
          std::span(bytes).first(static_cast<size_t>(part * static_cast<double>(bytes.size())));
      auto reader = SoundReader::Open(cut, "cut");
      if (reader.ok()) {
        std::vector<int16_t> samples(static_cast<size_t>(reader->frames()));
        EXPECT_LE(reader->Read(samples), samples.size());
      }
    }
  }
}

TEST(SoundLibrary, FindsByNameAndStreamsWhatIsLong) {
  const auto library =
      test::Library({test::Sound("street", test::Encode(test::Noise(6.0), 1, 8'000)),
                     test::Sound("bell", test::Encode(test::Click(0.5), 1))});
  EXPECT_EQ(library->Find("bell"), 0);
  EXPECT_EQ(library->Find("street"), 1);
  EXPECT_EQ(library->Find("horn"), -1);
  EXPECT_EQ(library->clips()[0].samples.size(), 24'000u);
  EXPECT_TRUE(library->clips()[1].samples.empty());
  EXPECT_DOUBLE_EQ(library->clips()[1].seconds(), 36.0);
}

TEST(SoundLibrary, ErrorsNameTheSound) {
  EXPECT_THAT(SoundLibrary::Load({test::Sound("bell", {})}).message(), HasSubstr("bell: "));
  const auto click = test::Encode(test::Click(0.1), 1);
  EXPECT_THAT(
      SoundLibrary::Load({test::Sound("bell", click), test::Sound("bell", click)}).message(),
      HasSubstr("bell: is the name of two sounds"));
  auto cut = click;
  cut.resize(cut.size() - 3000);
  const auto library = SoundLibrary::Load({test::Sound("bell", cut)});
  if (!library.ok()) {
    EXPECT_THAT(library.message(), HasSubstr("bell: "));
  }
}

}  // namespace
}  // namespace lararium::audio
