#include "shared/audio/mixer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/audio/test_sounds.h"

namespace lararium::audio {
namespace {

using test::Db;
using test::Encode;
using test::kRate;
using test::Rms;
using test::Sound;

Voice MakeVoice(int clip, const glm::vec3& position, double began = 0.0) {
  Voice voice;
  voice.source = 1;
  voice.clip = clip;
  voice.began = began;
  voice.position = position;
  return voice;
}

SoundScene SceneOf(std::vector<Voice> voices) {
  SoundScene scene;
  scene.voices = std::move(voices);
  return scene;
}

std::unique_ptr<Mixer> MakeMixer(std::shared_ptr<const SoundLibrary> library,
                                 bool hrtf = false,
                                 MixerOptions options = MixerOptions::ForFiles()) {
  options.hrtf = hrtf;
  auto mixer = Mixer::Create(std::move(library), options);
  EXPECT_TRUE(mixer.ok()) << mixer.message();
  return std::move(*mixer);
}

std::vector<float> Play(Mixer& mixer, const SoundScene& scene, double begin, double seconds) {
  std::vector<float> stereo(2 * static_cast<size_t>(std::llround(seconds * kRate)));
  mixer.Render(scene, begin, stereo);
  return stereo;
}

// Output of a new mixer.
std::vector<float> Play(const std::shared_ptr<const SoundLibrary>& library,
                        const SoundScene& scene,
                        double seconds,
                        bool hrtf = false) {
  return Play(*MakeMixer(library, hrtf), scene, 0.0, seconds);
}

float LargestStep(std::span<const float> stereo) {
  float largest = 0.0f;
  for (size_t i = 2; i < stereo.size(); ++i) {
    largest = std::max(largest, std::abs(stereo[i] - stereo[i - 2]));
  }
  return largest;
}

TEST(MixerOptions, LateStartBeyondTheLagIsRefused) {
  EXPECT_TRUE(MixerOptions().Validate().ok());
  EXPECT_TRUE(MixerOptions::ForFiles().Validate().ok());
  EXPECT_FALSE((MixerOptions{.max_lag = 0.05, .late_start = 0.1}).Validate().ok());
  EXPECT_FALSE((MixerOptions{.max_lead = 0.0}).Validate().ok());
}

TEST(Mixer, LevelFallsWithTheInverseOfTheDistance) {
  const auto library = test::Library({Sound("noise", Encode(test::Noise(1.0), 1))});
  for (const bool hrtf : {false, true}) {
    const auto at_1m = Play(library, SceneOf({MakeVoice(0, {0, 0, -1})}), 0.5, hrtf);
    const double reference = Rms(at_1m, 0, 0.1, 0.5);
    EXPECT_GT(reference, 0.02);
    for (const float metres : {0.3f, 2.0f, 4.0f, 10.0f}) {
      const auto heard = Play(library, SceneOf({MakeVoice(0, {0, 0, -metres})}), 0.5, hrtf);
      EXPECT_NEAR(Db(Rms(heard, 0, 0.1, 0.5) / reference),
                  -20.0 * std::log10(std::max(metres, 1.0f)), 0.1)
          << metres << " m, heads' filters " << hrtf;
    }
  }
}

TEST(Mixer, TheEarOnTheSideOfASourceHearsItLouderAndSooner) {
  const auto library = test::Library({Sound("noise", Encode(test::Noise(1.0), 1))});
  for (const float side : {-1.0f, 1.0f}) {
    const SoundScene ahead = SceneOf({MakeVoice(0, {0.5f * side, 0, -2})});
    const auto speakers = Play(library, ahead, 0.5, false);
    EXPECT_GT(-side * Db(Rms(speakers, 0, 0.1, 0.5) / Rms(speakers, 1, 0.1, 0.5)), 3.0);
    EXPECT_EQ(test::InterauralDelay(speakers), 0);

    const auto mixer = MakeMixer(library, true);
    const SoundScene scene = SceneOf({MakeVoice(0, {2 * side, 0, 0})});
    ASSERT_TRUE(mixer->hrtf()) << "the data of heads are missing: libopenal-data";
    const auto heads = Play(*mixer, scene, 0.0, 0.5);
    EXPECT_GT(-side * Db(Rms(heads, 0, 0.1, 0.5) / Rms(heads, 1, 0.1, 0.5)), 5.0);
    // 0.3 to 0.9 ms: the time of sound across a head.
    const double delay = side * test::InterauralDelay(heads) / static_cast<double>(kRate);
    EXPECT_GT(delay, 0.0003);
    EXPECT_LT(delay, 0.0009);
  }
}

TEST(Mixer, TurningTheHeadTurnsTheSound) {
  const auto library = test::Library({Sound("noise", Encode(test::Noise(1.0), 1))});
  SoundScene scene = SceneOf({MakeVoice(0, {0, 0, -2})});
  scene.listener.forward = {1, 0, 0};  // The source is now to the left.
  const auto heard = Play(library, scene, 0.5, true);
  EXPECT_GT(Db(Rms(heard, 0, 0.1, 0.5) / Rms(heard, 1, 0.1, 0.5)), 5.0);
}

// A sound of two channels. The right one is the left one multiplied by a factor.
std::vector<std::byte> TwoChannels(double seconds, float factor, test::Coding coding) {
  std::vector<float> stereo;
  for (const float sample : test::Noise(seconds)) {
    stereo.push_back(sample);
    stereo.push_back(factor * sample);
  }
  return Encode(stereo, 2, kRate, coding);
}

TEST(Mixer, ChannelsOfOppositePhaseDoNotCancelEachOther) {
  for (const double seconds : {1.0, SoundLibrary::kMaxHeldSeconds + 1.0}) {
    for (const auto coding : {test::Coding::kWav, test::Coding::kFlac, test::Coding::kVorbis}) {
      const auto library = test::Library({Sound("alike", TwoChannels(seconds, 1.0f, coding)),
                                          Sound("opposed", TwoChannels(seconds, -1.0f, coding))});
      const auto level = [&](int clip) {
        return Rms(Play(library, SceneOf({MakeVoice(clip, {0, 0, -1})}), 0.5), 0, 0.1, 0.5);
      };
      EXPECT_GT(level(0), 0.02);
      // Vorbis keeps less of a difference of two channels than of their sum.
      const double tolerance_db = coding == test::Coding::kVorbis ? 3.0 : 0.1;
      EXPECT_NEAR(Db(level(1) / level(0)), 0.0, tolerance_db) << seconds << " s";
    }
  }
}

TEST(Mixer, HeadLockedStereoIsPlayedAsItIs) {
  std::vector<float> samples = test::Noise(1.0);  // Half a second of two channels.
  const auto library = test::Library({Sound("room", Encode(samples, 2))});
  Voice voice = MakeVoice(0, {});
  voice.head_locked = true;
  SoundScene scene = SceneOf({voice});
  scene.listener.forward = {1, 0, 0};
  const auto heard = Play(library, scene, 0.5, true);
  ASSERT_EQ(heard.size(), samples.size());
  constexpr size_t kDelay = 2 * SoundGraph::kDelayFrames;
  for (size_t i = kDelay; i < heard.size(); ++i) {
    ASSERT_NEAR(heard[i], samples[i - kDelay], 1e-4) << i;
  }
}

TEST(Mixer, WhatBeginsWithinABlockBeginsAtItsSample) {
  const auto library = test::Library({Sound("click", Encode(test::Click(0.2), 1))});
  Voice voice = MakeVoice(0, {});
  voice.head_locked = true;
  for (const double began : {0.0, 0.01, 0.123456, 0.2}) {
    voice.began = began;
    const auto heard = Play(library, SceneOf({voice}), 0.3);
    const auto loudest = std::max_element(heard.begin(), heard.end()) - heard.begin();
    EXPECT_NEAR(static_cast<double>(loudest / 2) - SoundGraph::kDelayFrames,
                std::ceil(began * kRate - 1e-6), 1.0)
        << began;
  }
}

TEST(Mixer, SoughtIntoAClipGivesTheSamplesOfPlayingThere) {
  const auto library = test::Library(
      {Sound("held", Encode(test::Noise(3.0), 1)), Sound("streamed", Encode(test::Noise(6.0), 1))});
  for (int clip = 0; clip < 2; ++clip) {
    for (const bool loops : {false, true}) {
      Voice voice = MakeVoice(clip, {1, 0, -2}, 0.1);
      voice.loops = loops;
      const SoundScene scene = SceneOf({voice});
      const double at = loops ? 7.0 : 1.0;
      const auto whole = Play(library, scene, at + 0.5);
      const auto mixer = MakeMixer(library);
      const auto sought = Play(*mixer, scene, at, 0.5);
      const size_t begin = 2 * static_cast<size_t>(at * kRate);
      for (size_t i = 2 * 960; i < sought.size(); ++i) {  // After the fade.
        ASSERT_NEAR(sought[i], whole[begin + i], 2e-4) << i << " of clip " << clip << loops;
      }
    }
  }
}

TEST(Mixer, JumpingBackAndForthWithinAPlayGivesTheSameToo) {
  const auto library = test::Library({Sound("noise", Encode(test::Noise(4.0), 1))});
  const SoundScene scene = SceneOf({MakeVoice(0, {1, 0, -2})});
  const auto whole = Play(library, scene, 3.0);
  const auto mixer = MakeMixer(library);
  for (const double at : {0.0, 2.0, 1.0, 2.5}) {
    const auto heard = Play(*mixer, scene, at, 0.4);
    for (size_t i = 2 * 2400; i < heard.size(); ++i) {  // After both fades.
      ASSERT_NEAR(heard[i], whole[2 * static_cast<size_t>(at * kRate) + i], 2e-4) << at;
    }
  }
}

TEST(Mixer, LoopsHaveNoSeam) {
  // The clips contain whole periods.
  const auto library = test::Library({Sound("held", Encode(test::Tone(1.0, 100.0), 1)),
                                      Sound("streamed", Encode(test::Tone(6.0, 100.0), 1))});
  for (int clip = 0; clip < 2; ++clip) {
    Voice voice = MakeVoice(clip, {0, 0, -1});
    voice.loops = true;
    const auto heard = Play(library, SceneOf({voice}), 6.5);
    EXPECT_LT(LargestStep(std::span(heard).subspan(960)), 0.004f) << clip;
    EXPECT_NEAR(Db(Rms(heard, 0, 6.0, 6.5) / Rms(heard, 0, 0.5, 1.0)), 0.0, 0.1);
  }
}

TEST(Mixer, ObstructionTakesTheHighTonesFirst) {
  const auto library = test::Library({Sound("low", Encode(test::Tone(1.0, 200.0), 1)),
                                      Sound("tall", Encode(test::Tone(1.0, 6000.0), 1))});
  for (int clip = 0; clip < 2; ++clip) {
    Voice voice = MakeVoice(clip, {0, 0, -2});
    const auto open = Play(library, SceneOf({voice}), 0.5);
    voice.obstruction = 1.0f;
    const auto hidden = Play(library, SceneOf({voice}), 0.5);
    const double loss = -Db(Rms(hidden, 0, 0.2, 0.5) / Rms(open, 0, 0.2, 0.5));
    if (clip == 0) {
      EXPECT_NEAR(loss, 9.0, 1.0);
    } else {
      EXPECT_GT(loss, 20.0);
    }
  }
}

TEST(Mixer, WhatComesOutFromBehindSomethingDoesNotJump) {
  const auto library = test::Library({Sound("tone", Encode(test::Tone(2.0, 300.0), 1))});
  const auto mixer = MakeMixer(library);
  Voice voice = MakeVoice(0, {0, 0, -1});
  voice.obstruction = 1.0f;
  Play(*mixer, SceneOf({voice}), 0.0, 0.5);
  voice.obstruction = 0.0f;
  const auto heard = Play(*mixer, SceneOf({voice}), 0.5, 0.5);
  EXPECT_LT(Rms(heard, 0, 0.0, 0.02), 0.6 * Rms(heard, 0, 0.3, 0.5));
  EXPECT_LT(LargestStep(heard), 0.012f);
}

TEST(Mixer, WhoTurnsAwayIsHeardDuller) {
  const auto library = test::Library({Sound("tall", Encode(test::Tone(1.0, 5000.0), 1))});
  Voice voice = MakeVoice(0, {0, 0, -2});
  voice.facing = {0, 0, 1};
  const auto towards = Play(library, SceneOf({voice}), 0.5);
  voice.facing = {0, 0, -1};
  const auto away = Play(library, SceneOf({voice}), 0.5);
  const double loss = -Db(Rms(away, 0, 0.1, 0.5) / Rms(towards, 0, 0.1, 0.5));
  EXPECT_GT(loss, 8.0);
  EXPECT_LT(loss, 16.0);
}

TEST(Mixer, AllElseGoesDownWhileSomethingIsDescribed) {
  const std::vector<float> silence(2 * kRate);
  const auto library = test::Library(
      {Sound("pause", Encode(silence, 1)), Sound("voice", Encode(test::Tone(6.0, 500.0), 1))});
  Voice speaker = MakeVoice(1, {0, 0, -1});
  speaker.source = 2;
  speaker.bus = Bus::kSpeech;
  Voice description = MakeVoice(0, {}, 1.0);
  description.bus = Bus::kDescription;
  description.head_locked = true;
  const auto heard = Play(library, SceneOf({speaker, description}), 6.0);
  const double before = Rms(heard, 0, 0.5, 1.0);
  EXPECT_NEAR(Db(Rms(heard, 0, 2.0, 3.0) / before), kDescribedDb[0], 0.3);
  EXPECT_NEAR(Db(Rms(heard, 0, 5.5, 5.9) / before), 0.0, 0.3);
}

TEST(Mixer, AmbienceGoesDownWhileSomebodySpeaksNearby) {
  const std::vector<float> silence(2 * kRate);
  const auto library = test::Library(
      {Sound("pause", Encode(silence, 1)), Sound("room", Encode(test::Tone(3.0, 500.0), 1))});
  Voice room = MakeVoice(1, {});
  room.source = 2;
  room.bus = Bus::kAmbience;
  room.loops = true;
  room.head_locked = true;
  // A speaker with a silent voice, so that the rest can be measured.
  Voice speaker = MakeVoice(0, {0, 0, -1}, 1.0);
  speaker.bus = Bus::kSpeech;
  const auto heard = Play(library, SceneOf({room, speaker}), 6.0);
  const double before = Rms(heard, 0, 0.5, 1.0);
  EXPECT_NEAR(Db(Rms(heard, 0, 2.0, 3.0) / before), kDuckDb[2], 0.2);
  EXPECT_NEAR(Db(Rms(heard, 0, 5.7, 6.0) / before), 0.0, 0.3);
  EXPECT_LT(LargestStep(heard), 0.02f);

  // A distant speaker does not lower it.
  speaker.position = {0, 0, -30};
  const auto far = Play(library, SceneOf({room, speaker}), 3.0);
  EXPECT_GT(Db(Rms(far, 0, 2.0, 3.0) / before), -1.5);
}

TEST(Mixer, WhatStopsFadesAndThenIsSilent) {
  const auto library = test::Library({Sound("tone", Encode(test::Tone(2.0, 300.0), 1))});
  const auto mixer = MakeMixer(library);
  Play(*mixer, SceneOf({MakeVoice(0, {0, 0, -1})}), 0.0, 0.5);
  EXPECT_EQ(mixer->playing(), 1u);
  const auto heard = Play(*mixer, SceneOf({}), 0.5, 0.2);
  EXPECT_LT(LargestStep(heard), 0.012f);
  EXPECT_LT(Rms(heard, 0, 0.05, 0.2), 1e-4);
  EXPECT_EQ(mixer->playing(), 0u);
}

TEST(Mixer, KeepsTheOnsetOfWhatItHearsOfLate) {
  const auto library = test::Library({Sound("click", Encode(test::Click(0.5), 1))});
  Voice voice = MakeVoice(0, {});
  voice.head_locked = true;
  const auto mixer = MakeMixer(library, false, MixerOptions());
  Play(*mixer, SceneOf({}), 0.0, 0.1);
  voice.began = 0.04;
  const auto heard = Play(*mixer, SceneOf({voice}), 0.1, 0.1);
  EXPECT_NEAR(*std::max_element(heard.begin(), heard.begin() + 2 * SoundGraph::kDelayFrames + 8),
              0.5f, 0.01f);
  // A voice that began long ago starts in the middle of its clip.
  voice.source = 2;
  voice.began = -0.2;
  const auto later = Play(*mixer, SceneOf({voice}), 0.2, 0.1);
  EXPECT_LT(*std::max_element(later.begin(), later.end()), 1e-3f);
}

TEST(Mixer, PutsRightWhatHasDriftedTooFarAndNothingElse) {
  const auto library = test::Library({Sound("noise", Encode(test::Noise(4.0), 1))});
  Voice voice = MakeVoice(0, {});
  voice.head_locked = true;
  for (const double drift : {-0.12, 0.04, -0.2, 0.1}) {  // Jumps of the drama, seconds.
    const auto mixer = MakeMixer(library, false, MixerOptions());
    Play(*mixer, SceneOf({voice}), 0.0, 1.0);
    const auto heard = Play(*mixer, SceneOf({voice}), 1.0 - drift, 0.5);
    const auto whole = Play(library, SceneOf({voice}), 3.0);
    const bool goes_on = drift == -0.12 || drift == 0.04;
    const double from = goes_on ? 1.0 : 1.0 - drift;
    const auto expected =
        std::span(whole).subspan(2 * static_cast<size_t>(std::lround(from * kRate)));
    for (size_t i = 2 * 4800; i < heard.size(); ++i) {
      ASSERT_NEAR(heard[i], expected[i], 2e-4) << drift;
    }
  }
}

TEST(Mixer, AClipThatIsOverIsNotPlayedAgain) {
  const auto library = test::Library({Sound("tone", Encode(test::Tone(0.2, 300.0), 1))});
  const auto mixer = MakeMixer(library, false, MixerOptions());
  const SoundScene scene = SceneOf({MakeVoice(0, {0, 0, -1})});
  Play(*mixer, scene, 0.0, 0.2);
  EXPECT_LT(Rms(Play(*mixer, scene, 0.2, 1.0), 0, 0.02, 1.0), 1e-5);
}

TEST(Mixer, WhereThereAreTooManyTheQuietestAreNotHeard) {
  const auto library = test::Library({Sound("tone", Encode(test::Tone(1.0, 300.0), 1))});
  std::vector<Voice> voices;
  for (uint64_t i = 0; i < 60; ++i) {
    Voice voice = MakeVoice(0, {0, 0, -static_cast<float>(1 + i)});
    voice.source = 100 - i;
    voices.push_back(voice);
  }
  std::reverse(voices.begin(), voices.end());
  const auto mixer = MakeMixer(library);
  const auto heard = Play(*mixer, SceneOf(voices), 0.0, 0.2);
  EXPECT_EQ(mixer->playing(), SoundGraph::kSources);
  for (const float sample : heard) {
    ASSERT_LE(std::abs(sample), 1.0f);
  }
}

TEST(Mixer, ReverberationOutlastsTheSound) {
  const auto library = test::Library({Sound("click", Encode(test::Click(0.1), 1))});
  SoundScene scene = SceneOf({MakeVoice(0, {0, 0, -2})});
  const auto dry = Play(library, scene, 1.0);
  scene.reverb = stage::Reverb::kVault;
  const auto vault = Play(library, scene, 1.0);
  EXPECT_LT(Rms(dry, 0, 0.3, 0.6), 1e-6);
  EXPECT_GT(Rms(vault, 0, 0.3, 0.6), 1e-5);
  EXPECT_GT(Rms(vault, 0, 0.1, 0.3), Rms(vault, 0, 0.7, 1.0));
}

TEST(Mixer, TheSameScenesGiveTheSameSamples) {
  const auto library = test::Library({Sound("noise", Encode(test::Noise(6.0), 1, 44'100))});
  Voice voice = MakeVoice(0, {1, 1, -2}, 0.05);
  SoundScene scene = SceneOf({voice});
  scene.reverb = stage::Reverb::kStoneRoom;
  EXPECT_EQ(Play(library, scene, 1.0, true), Play(library, scene, 1.0, true));
}

}  // namespace
}  // namespace lararium::audio
