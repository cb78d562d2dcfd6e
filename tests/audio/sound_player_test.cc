#include "shared/audio/sound_player.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>

#include <atomic>
#include <cmath>
#include <sstream>
#include <thread>

#include "tests/audio/test_sounds.h"

namespace lararium::audio {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

// Records what happens to fake devices, and outlives them.
struct Happenings {
  std::atomic<int> opened = 0;
  std::atomic<int> written = 0;
  std::atomic<int> loud = 0;  // Number of blocks that were not silent.
  std::atomic<bool> there = true;
  std::atomic<int> lost_after = -1;  // Number of blocks; -1: never.
};

// A device that accepts a block per millisecond and may be lost.
class FakeDevice : public AudioOut {
 public:
  explicit FakeDevice(Happenings& happenings) : happenings_(happenings) { ++happenings_.opened; }
  Status Write(std::span<const float> stereo) override {
    if (happenings_.lost_after >= 0 && written_ >= happenings_.lost_after) {
      return Status::Error("sound device", "was lost");
    }
    ++written_;
    ++happenings_.written;
    const bool silent = std::all_of(stereo.begin(), stereo.end(),
                                    [](float sample) { return std::abs(sample) < 1e-4f; });
    happenings_.loud += silent ? 0 : 1;
    std::this_thread::sleep_for(1ms);
    return Status();
  }
  double latency() const override { return 0.04; }
  Status Finish() override { return Status(); }
  std::string name() const override { return "the double"; }

 private:
  Happenings& happenings_;
  int written_ = 0;
};

class Player : public testing::Test {
 protected:
  Player()
      : log_("test", std::make_shared<spdlog::sinks::ostream_sink_mt>(text_)),
        library_(test::Library({test::Sound("tone", test::Encode(test::Tone(1.0, 300.0), 1))})) {}

  std::unique_ptr<SoundPlayer> Start() {
    return std::make_unique<SoundPlayer>(
        *Mixer::Create(library_, {}),
        [this]() -> Result<std::unique_ptr<AudioOut>> {
          if (!happenings_.there) {
            return Status::Error("sound device", "there is none");
          }
          return std::unique_ptr<AudioOut>(std::make_unique<FakeDevice>(happenings_));
        },
        log_);
  }

  static SoundScene Sounding(double time) {
    SoundScene scene;
    scene.time = time;
    Voice& voice = scene.voices.emplace_back();
    voice.clip = 0;
    voice.loops = true;
    return scene;
  }

  template <typename Condition>
  static bool Wait(Condition condition) {
    for (int i = 0; i < 400 && !condition(); ++i) {
      std::this_thread::sleep_for(5ms);
    }
    return condition();
  }

  std::ostringstream text_;
  Log log_;
  std::shared_ptr<const SoundLibrary> library_;
  Happenings happenings_;
};

TEST_F(Player, PlaysWhatIsShown) {
  const auto player = Start();
  player->Show(Sounding(0.0));
  EXPECT_TRUE(Wait([&] { return happenings_.loud > 3; }));
  EXPECT_EQ(happenings_.opened, 1);
}

TEST_F(Player, IsSilentBeforeAnythingIsShown) {
  const auto player = Start();
  EXPECT_TRUE(Wait([&] { return happenings_.written > 20; }));
  EXPECT_EQ(happenings_.loud, 0);
}

TEST_F(Player, WhatIsNotShownAnyMoreFallsSilent) {
  const auto player = Start();
  player->Show(Sounding(0.0));
  ASSERT_TRUE(Wait([&] { return happenings_.loud > 0; }));
  std::this_thread::sleep_for(450ms);
  const int loud = happenings_.loud;
  const int written = happenings_.written;
  ASSERT_TRUE(Wait([&] { return happenings_.written > written + 20; }));
  EXPECT_EQ(happenings_.loud, loud);
}

TEST_F(Player, WithoutADeviceGoesOnInSilenceAndSaysSoOnce) {
  happenings_.there = false;
  {
    const auto player = Start();
    player->Show(Sounding(0.0));
    std::this_thread::sleep_for(100ms);
  }
  EXPECT_EQ(happenings_.opened, 0);
  const std::string log = text_.str();
  EXPECT_THAT(log, HasSubstr("there is none; the show goes on in silence"));
  EXPECT_EQ(log.find("silence"), log.rfind("silence"));
}

TEST_F(Player, ALostDeviceIsSurvivedAndSaidOnce) {
  happenings_.lost_after = 5;
  {
    const auto player = Start();
    player->Show(Sounding(0.0));
    ASSERT_TRUE(Wait([&] { return happenings_.written == 5; }));
    std::this_thread::sleep_for(100ms);
    EXPECT_EQ(happenings_.opened, 1);
  }
  const std::string log = text_.str();
  EXPECT_THAT(log, HasSubstr("sound goes to the double"));
  EXPECT_THAT(log, HasSubstr("was lost; the show goes on in silence"));
  EXPECT_EQ(log.find("silence"), log.rfind("silence"));
}

TEST(SoundClock, FollowsTheDramaThroughUnevenFrames) {
  SoundClock clock;
  const Clock::time_point zero{};
  const auto at = [&](double seconds) {
    return zero +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  };
  double last = clock.Next(5.0, at(0.0), at(0.05), 0.01);
  EXPECT_NEAR(last, 5.05, 1e-9);
  for (int i = 1; i < 200; ++i) {
    const double real = 0.01 * i;
    const double jitter = i % 3 == 0 ? 0.02 : 0.0;
    const double next = clock.Next(5.0 + real, at(real + jitter), at(real + 0.05), 0.01);
    EXPECT_NEAR(next - last, 0.01, 0.001) << i;
    EXPECT_NEAR(next, 5.05 + real, 0.03);
    last = next;
  }
}

TEST(SoundClock, JumpsWithTheDrama) {
  SoundClock clock;
  const Clock::time_point now{};
  clock.Next(5.0, now, now, 0.01);
  EXPECT_NEAR(clock.Next(65.0, now, now, 0.01), 65.0, 1e-9);
  EXPECT_NEAR(clock.Next(2.0, now, now, 0.01), 2.0, 1e-9);
}

}  // namespace
}  // namespace lararium::audio
