#include "shared/audio/sound_track.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "shared/audio/audio_out.h"
#include "shared/core/file.h"
#include "tests/audio/test_sounds.h"
#include "tests/support/test_files.h"

namespace lararium::audio {
namespace {

SoundScene ClickAt(double began, double time) {
  SoundScene scene;
  scene.time = time;
  scene.frame_time = time;
  if (time >= began) {  // The voice is unknown before it begins.
    Voice& voice = scene.voices.emplace_back();
    voice.clip = 0;
    voice.began = began;
    voice.head_locked = true;
  }
  return scene;
}

TEST(SoundTrack, AClickIsAtItsSampleWhateverTheFrameRate) {
  const auto library = test::Library({test::Sound("click", test::Encode(test::Click(0.4), 1))});
  for (const double frames_per_second : {10.0, 24.0, 30.0, 60.0}) {
    std::vector<float> all;
    auto track = SoundTrack::Create(library, true, [&](std::span<const float> stereo) {
      all.insert(all.end(), stereo.begin(), stereo.end());
      return Status();
    });
    ASSERT_TRUE(track.ok()) << track.message();
    for (int frame = 0; frame < frames_per_second; ++frame) {
      ASSERT_TRUE((*track)->RenderUntil(ClickAt(0.4321, frame / frames_per_second)).ok());
    }
    ASSERT_TRUE((*track)->RenderOn(1.0 / frames_per_second).ok());
    EXPECT_EQ(all.size(), 2u * test::kRate);
    const auto loudest = (std::max_element(all.begin(), all.end()) - all.begin()) / 2;
    EXPECT_NEAR(static_cast<double>(loudest) - SoundGraph::kDelayFrames,
                std::ceil(0.4321 * test::kRate), 1.0);
  }
}

TEST(SoundTrack, GoingBackGivesNothing) {
  const auto library = test::Library({test::Sound("click", test::Encode(test::Click(0.4), 1))});
  size_t frames = 0;
  auto track = SoundTrack::Create(library, false, [&](std::span<const float> stereo) {
    frames += stereo.size() / 2;
    return Status();
  });
  ASSERT_TRUE(track.ok());
  ASSERT_TRUE((*track)->RenderUntil(ClickAt(0.0, 0.5)).ok());
  ASSERT_TRUE((*track)->RenderUntil(ClickAt(0.0, 0.2)).ok());
  EXPECT_EQ(frames, 24'000u);
}

TEST(SoundTrack, GoesOnWithOtherSoundsAtTheSampleWhereItIs) {
  const auto before = test::Library({test::Sound("other", test::Encode(test::Click(0.4), 1)),
                                     test::Sound("more", test::Encode(test::Click(0.4), 1))});
  const auto after = test::Library({test::Sound("click", test::Encode(test::Click(0.4), 1))});
  std::vector<float> all;
  auto track = SoundTrack::Create(before, false, [&](std::span<const float> stereo) {
    all.insert(all.end(), stereo.begin(), stereo.end());
    return Status();
  });
  ASSERT_TRUE(track.ok()) << track.message();
  SoundScene scene = ClickAt(0.0, 0.5);
  scene.voices.front().clip = 1;  // The next library has no clip 1.
  ASSERT_TRUE((*track)->RenderUntil(scene).ok());
  ASSERT_TRUE((*track)->SetLibrary(after).ok());
  ASSERT_TRUE((*track)->RenderUntil(ClickAt(0.75, 1.0)).ok());
  ASSERT_EQ(all.size(), 2u * test::kRate);
  const auto loudest = (std::max_element(all.begin() + test::kRate, all.end()) - all.begin()) / 2;
  EXPECT_NEAR(static_cast<double>(loudest) - SoundGraph::kDelayFrames, 0.75 * test::kRate, 1.0);
}

TEST(AudioOut, AFileIsThereWhenItIsFinished) {
  const test::TemporaryFolder folder;
  auto out = CreateAudioOut(AudioOutKind::kFile, folder / "mix.wav");
  ASSERT_TRUE(out.ok()) << out.message();
  const std::vector<float> noise = test::Noise(0.5);
  ASSERT_TRUE((*out)->Write(noise).ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "mix.wav"));
  ASSERT_TRUE((*out)->Finish().ok());
  const auto bytes = ReadBytes(folder / "mix.wav");
  ASSERT_TRUE(bytes.ok());
  auto reader = SoundReader::Open(*bytes, "mix.wav");
  ASSERT_TRUE(reader.ok()) << reader.message();
  EXPECT_EQ(reader->frames(), static_cast<int64_t>(noise.size() / 2));
  EXPECT_EQ(reader->channels(), 2);
}

TEST(AudioOut, AnUnfinishedFileLeavesNothing) {
  const test::TemporaryFolder folder;
  {
    auto out = CreateAudioOut(AudioOutKind::kFile, folder / "mix.wav");
    ASSERT_TRUE(out.ok());
    ASSERT_TRUE((*out)->Write(test::Noise(0.1)).ok());
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THAT(CreateAudioOut(AudioOutKind::kFile, folder / "no/mix.wav").message(),
              testing::HasSubstr("mix.wav: cannot be written"));
}

// Opens the machine's device if there is one; otherwise expects an error.
TEST(AudioOut, ADeviceIsThereOrAnErrorSaysSo) {
  auto out = CreateAudioOut(AudioOutKind::kDevice);
  if (!out.ok()) {
    EXPECT_THAT(out.message(), testing::HasSubstr("sound device: "));
    return;
  }
  const std::vector<float> silence(2 * Mixer::kBlockFrames);
  EXPECT_TRUE((*out)->Write(silence).ok());
}

TEST(AudioOut, NoneKeepsTheTime) {
  auto out = CreateAudioOut(AudioOutKind::kNone);
  ASSERT_TRUE(out.ok());
  const std::vector<float> silence(2 * Mixer::kBlockFrames);
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE((*out)->Write(silence).ok());
  }
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(40));
}

}  // namespace
}  // namespace lararium::audio
