#include "shared/drama/drama.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "shared/core/file.h"
#include "shared/core/random.h"
#include "tests/drama/drama_fixture.h"
#include "tests/support/test_files.h"

namespace lararium::drama {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kTracks[] = R"(
  track{ actor = "keeper", clips = {
    { at = 0, length = 4, clip = "idle", from = {x = 0, z = -2}, heading = 180 },
    { at = 4, length = 6, clip = "walk", to = {x = 4.2, z = -2} },
    { at = 12, length = 1, clip = "bow", heading = 90 },
  } }
  track{ actor = "guest", clips = { { at = 3, length = 2, clip = "idle", from = {x = 1} } } }
)";

constexpr char kTasks[] = R"(
  local keeper, guest = actor("keeper"), actor("guest")
  function main()
    keeper:place{ x = -1, z = -2, heading = 180 }
    keeper:play("idle", {fade = 0})
    start(function()
      while true do
        wait(0.5 + math.random())
        guest:place{ x = math.random(-3, 3), z = -4 }
        guest:play(math.random() < 0.5 and "idle" or "bow")
      end
    end)
    while true do
      together(
        function() keeper:walk_to{ x = 1, z = -2 } end,
        function() wait(1) end)
      race(
        function() keeper:walk_to{ x = -1, z = -3, speed = 0.5 } end,
        function() wait(2) end)
      keeper:turn_to(0)
    end
  end
)";

TEST_F(DramaTest, ActorsAreHiddenUntilTheyArePlaced) {
  const auto drama = Make(R"(
    function main()
      wait(1)
      actor("keeper"):place{ x = 1, y = 0.5, z = -2, heading = 90 }
    end)");
  PlayTo(*drama, 0.99);
  EXPECT_FALSE(State("keeper").visible);
  PlayTo(*drama, 1.0);
  EXPECT_TRUE(State("keeper").visible);
  EXPECT_FALSE(State("guest").visible);
  EXPECT_EQ(State("keeper").position, glm::vec3(1.0f, 0.5f, -2.0f));
  EXPECT_FLOAT_EQ(State("keeper").heading, std::numbers::pi_v<float> / 2.0f);
  EXPECT_EQ(FirstError(*drama), "");
}

TEST_F(DramaTest, AScriptMayBeginWithAByteOrderMark) {
  const auto drama = Make(
      "\xEF\xBB\xBF"
      "function main() error('here') end");
  EXPECT_EQ(FirstError(*drama), "drama.lua:1: here");
}

TEST_F(DramaTest, WhatIsNoTextIsRefusedWithFileAndLine) {
  const std::pair<std::string, std::string> scripts[] = {
      {std::string("\xFF\xFE"
                   "f\0n\0",
                   6),
       "drama.lua:1: holds a zero byte"},
      {std::string("-- one\nx = '\0'", 13), "drama.lua:2: holds a zero byte"},
      {"\x1BLua", "drama.lua:1: is compiled Lua"},
  };
  for (const auto& [script, problem] : scripts) {
    const auto drama = Drama::Create(script, "drama.lua", stage_, {}, *log_);
    ASSERT_FALSE(drama.ok());
    EXPECT_THAT(drama.message(), HasSubstr(problem));
  }
}

TEST_F(DramaTest, WaitingWhereLuaCannotIsAnErrorWithItsLine) {
  const auto sorts = Make(
      "function main()\n  table.sort({1, 2, 3}, function(a, b)\n    wait(1)\n    return a < b\n  "
      "end)\nend");
  EXPECT_THAT(FirstError(*sorts), HasSubstr("drama.lua:3: wait: cannot wait within a function"));
  const auto yields = Make(
      "function main()\n  string.gsub('a', 'a', function()\n    coroutine.yield()\n  end)\nend");
  EXPECT_THAT(FirstError(*yields), HasSubstr("drama.lua:3: attempt to yield"));
}

TEST_F(DramaTest, TickZeroIsPlayedOnCreation) {
  Make("function main() actor('keeper'):place{ x = 3 } end");
  EXPECT_EQ(State("keeper").position.x, 3.0f);
}

TEST_F(DramaTest, PlayFadesFromClipToClip) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:play("idle", {fade = 0})
      wait(1)
      keeper:play("walk", {fade = 0.5})
    end)");
  PlayTo(*drama, 1.25);
  const human::Animation& animation = State("keeper").animation_state.animation;
  EXPECT_EQ(animation.clip, 1);
  EXPECT_EQ(animation.previous_clip, 0);
  EXPECT_NEAR(animation.clip_time, 0.25, 1e-9);
  EXPECT_NEAR(animation.previous_time, 1.25, 1e-9);
  EXPECT_NEAR(animation.weight, 0.5f, 1e-4);
}

TEST_F(DramaTest, PlayingALoopAgainGoesOn) {
  const auto drama = Make(R"(
    function main()
      while true do actor("keeper"):play("idle") wait(0.1) end
    end)");
  PlayTo(*drama, 1.0);
  EXPECT_NEAR(State("keeper").animation_state.animation.clip_time, 1.0, 1e-9);
}

TEST_F(DramaTest, WalksAtTheClipsOwnSpeedAndEndsExactly) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{ x = 0, z = 0, heading = 0 }
      keeper:walk_to{ x = 0, z = -2.8, heading = 90 }
      keeper:hide()
    end)");
  PlayTo(*drama, 1.0);
  const float begin = State("keeper").position.z;
  PlayTo(*drama, 1.5);
  EXPECT_NEAR(State("keeper").position.z - begin, -0.7f, 0.02f);
  EXPECT_EQ(State("keeper").animation_state.animation.clip, 1);
  EXPECT_NEAR(State("keeper").animation_state.animation.rate, 1.0, 0.02);
  PlayTo(*drama, 2.0);
  EXPECT_TRUE(State("keeper").visible);
  PlayTo(*drama, 5.0);
  EXPECT_FALSE(State("keeper").visible);
  EXPECT_EQ(State("keeper").position, glm::vec3(0.0f, 0.0f, -2.8f));
  EXPECT_FLOAT_EQ(State("keeper").heading, std::numbers::pi_v<float> / 2.0f);
  EXPECT_EQ(State("keeper").animation_state.animation.clip, 0) << "idles after a walk";
  EXPECT_EQ(FirstError(*drama), "");
}

TEST_F(DramaTest, AWalkAtAnotherSpeedKeepsStep) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{ heading = 0 }
      keeper:walk_to{ z = -10, speed = 0.7 }
    end)");
  PlayTo(*drama, 2.0);
  const float begin = State("keeper").position.z;
  PlayTo(*drama, 4.0);
  EXPECT_NEAR(State("keeper").position.z - begin, -1.4f, 0.02f);
  EXPECT_NEAR(State("keeper").animation_state.animation.rate, 0.5, 0.01);
}

TEST_F(DramaTest, FacesWhereItWalks) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{ heading = 90 }
      keeper:walk_to{ x = 5 }
    end)");
  PlayTo(*drama, 0.5);
  EXPECT_EQ(State("keeper").position.x, 0.0f) << "turns first";
  PlayTo(*drama, 3.0);
  EXPECT_NEAR(State("keeper").heading, -std::numbers::pi / 2.0, 0.02) << "+x is to the right";
  EXPECT_GT(State("keeper").position.x, 1.4f);
}

TEST_F(DramaTest, TurnsTheShorterWayAtItsSpeed) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{ heading = 170 }
      keeper:turn_to(-100, {speed = 45})
      keeper:hide()
    end)");
  PlayTo(*drama, 1.0);
  EXPECT_NEAR(State("keeper").heading, 215.0 / 180.0 * std::numbers::pi, 0.01);
  PlayTo(*drama, 1.95);
  EXPECT_TRUE(State("keeper").visible);
  PlayTo(*drama, 2.1);
  EXPECT_FALSE(State("keeper").visible);
  EXPECT_NEAR(State("keeper").heading, 260.0 / 180.0 * std::numbers::pi, 1e-4);
}

TEST_F(DramaTest, WhereNobodyCanWalkItGoesAsNearAsItCan) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{ x = 8 }
      local reached = keeper:walk_to{ x = 14 }
      keeper:place{ z = reached and 1 or 2 }
    end)");
  PlayTo(*drama, 6.0);
  EXPECT_NEAR(State("keeper").position.x, 9.75f, 0.1f) << "the floor ends at 10 m";
  EXPECT_EQ(State("keeper").position.z, 2.0f);
  EXPECT_THAT(FirstError(*drama), StartsWith("drama.lua:5: walk_to: 'keeper' cannot get there"));
  EXPECT_THAT(FirstError(*drama), HasSubstr("the nearest place is x = 9.68"));
}

TEST_F(DramaTest, TogetherWaitsForAllAndRaceForOne) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      together(function() wait(1) end, function() wait(2) end)
      keeper:place{ x = now() }
      race(function() wait(1) end, function() wait(3) keeper:place{ x = 99 } end)
      keeper:place{ x = now() }
    end)");
  PlayTo(*drama, 2.5);
  EXPECT_EQ(State("keeper").position.x, 2.0f);
  PlayTo(*drama, 10.0);
  EXPECT_EQ(State("keeper").position.x, 3.0f);
  EXPECT_EQ(FirstError(*drama), "");
}

TEST_F(DramaTest, ALosersOwnTasksStopWithIt) {
  const auto drama = Make(R"(
    function main()
      race(
        function() wait(1) end,
        function()
          together(function() wait(2) actor("guest"):place{ x = 7 } end, function() wait(9) end)
        end)
    end)");
  PlayTo(*drama, 5.0);
  EXPECT_FALSE(State("guest").visible);
}

TEST_F(DramaTest, AnInterruptedWalkEndsInIdle) {
  const auto drama = Make(R"(
    function main()
      actor("keeper"):place{}
      race(function() wait(1) end, function() actor("keeper"):walk_to{ z = -9 } end)
    end)");
  PlayTo(*drama, 1.5);
  EXPECT_EQ(State("keeper").animation_state.animation.clip, 0);
  const float stopped = State("keeper").position.z;
  EXPECT_LT(stopped, -0.5f);
  PlayTo(*drama, 2.0);
  EXPECT_EQ(State("keeper").position.z, stopped);
}

TEST_F(DramaTest, CompileErrorsNameFileAndLine) {
  const auto drama =
      Drama::Create("local x = 1\nlocal y = = 2\n", "drama.lua", stage_, DramaOptions(), *log_);
  ASSERT_FALSE(drama.ok());
  EXPECT_THAT(drama.message(), HasSubstr("drama.lua:2:"));
}

TEST_F(DramaTest, BinaryChunksAreRefused) {
  const auto drama = Drama::Create("\x1bLua\x54", "drama.lua", stage_, DramaOptions(), *log_);
  ASSERT_FALSE(drama.ok());
  EXPECT_THAT(drama.message(), HasSubstr("drama.lua:1: is compiled Lua"));
}

TEST_F(DramaTest, AnErrorEndsItsTaskAndTheShowGoesOn) {
  const auto drama = Make(R"(
    function main()
      start(function()
        wait(1)
        local nothing
        nothing.x = 1
      end)
      actor("keeper"):place{}
      wait(2)
      actor("keeper"):place{ x = 2 }
    end)");
  PlayTo(*drama, 3.0);
  ASSERT_EQ(drama->errors().size(), 1u);
  EXPECT_THAT(drama->errors()[0].message, StartsWith("drama.lua:6:"));
  EXPECT_THAT(drama->errors()[0].traceback, HasSubstr("drama.lua:6"));
  EXPECT_EQ(drama->errors()[0].time, 1.0);
  EXPECT_EQ(State("keeper").position.x, 2.0f);
}

TEST_F(DramaTest, MistakesInCallsAreBlamedOnTheScript) {
  const struct {
    const char* call;
    const char* problem;
  } kMistakes[] = {
      {"actor('nobody')", "there is no 'nobody' in the cast"},
      {"actor('keeper'):play('fly')", "has no clip 'fly'"},
      {"actor('keeper'):place{ x = 'left' }", "x must be a number"},
      {"actor('keeper'):place{ x = 0/0 }", "x must be a number"},
      {"actor('keeper'):walk_to{ x = 1, speed = 0 }", "speed must be more than 0"},
      {"wait('long')", "give a number of seconds"},
      {"wait(-1)", "give a number of seconds"},
      {"together(1)", "give functions"},
      {"coroutine.wrap(function() wait(1) end)()", "only within main()"},
      {"track{ actor = 'keeper', clips = {{ at = 0, length = 1, clip = 'idle' }} }",
       "only while the script loads"},
  };
  for (const auto& mistake : kMistakes) {
    const auto drama = Make(std::string("function main()\n") + mistake.call + "\nend");
    EXPECT_THAT(FirstError(*drama), HasSubstr(mistake.problem)) << mistake.call;
    EXPECT_THAT(FirstError(*drama), StartsWith("drama.lua:2:")) << mistake.call;
  }
}

TEST_F(DramaTest, ATrackedActorTakesNoCommands) {
  const auto drama = Make(std::string(kTracks) + "function main() actor('keeper'):play('bow') end");
  EXPECT_THAT(FirstError(*drama), HasSubstr("'keeper' is led by a track"));
}

TEST_F(DramaTest, TracksIdleBetweenTheirClips) {
  const auto drama = Make(kTracks);
  ASSERT_EQ(FirstError(*drama), "");
  PlayTo(*drama, 7.0);
  EXPECT_NEAR(State("keeper").position.x, 2.1f, 1e-5);
  EXPECT_NEAR(State("keeper").animation_state.animation.rate, 0.5, 1e-6)
      << "0.7 m/s with a 1.4 m/s walk";
  EXPECT_NEAR(State("keeper").heading, -std::numbers::pi / 2.0, 1e-5);
  PlayTo(*drama, 11.0);
  EXPECT_EQ(State("keeper").animation_state.animation.clip, 0);
  EXPECT_FLOAT_EQ(State("keeper").position.x, 4.2f);
  PlayTo(*drama, 12.5);
  EXPECT_EQ(State("keeper").animation_state.animation.clip, 2);
  PlayTo(*drama, 20.0);
  EXPECT_EQ(State("keeper").animation_state.animation.clip, 0);
}

// Seeking gives the same result as playing, bit for bit.
class SeekTest : public DramaTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(SeekTest, EqualsPlaying) {
  constexpr int kTicks = 20 * Drama::kTicksPerSecond;
  std::vector<stage::StageSnapshot> played;
  const auto drama = Make(GetParam());
  played.push_back(Snapshot());
  for (int i = 1; i <= kTicks; ++i) {
    drama->Tick();
    played.push_back(Snapshot());
  }
  ASSERT_EQ(FirstError(*drama), "");
  Random random(3);
  for (int i = 0; i < 12; ++i) {
    const uint32_t tick = random.Below(kTicks + 1);
    ASSERT_TRUE(drama->Seek(static_cast<double>(tick) / Drama::kTicksPerSecond).ok());
    EXPECT_EQ(drama->time(), static_cast<double>(tick) / Drama::kTicksPerSecond);
    EXPECT_TRUE(Snapshot() == played[tick]) << "tick " << tick;
    if (tick < kTicks) {
      drama->Tick();
      EXPECT_TRUE(Snapshot() == played[tick + 1]) << "after tick " << tick;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Dramas, SeekTest, ::testing::Values(kTracks, kTasks));

TEST_F(DramaTest, SeekingRefusesImpossibleTimes) {
  const auto drama = Make(kTasks);
  EXPECT_FALSE(drama->Seek(-1.0).ok());
  EXPECT_FALSE(drama->Seek(std::nan("")).ok());
  EXPECT_FALSE(drama->Seek(1e9).ok());
}

TEST_F(DramaTest, SeekingKeepsTheErrorsUntilThen) {
  const auto drama = Make("function main() wait(1) error('one') end");
  PlayTo(*drama, 2.0);
  EXPECT_EQ(drama->errors().size(), 1u);
  ASSERT_TRUE(drama->Seek(0.5).ok());
  EXPECT_TRUE(drama->errors().empty());
  ASSERT_TRUE(drama->Seek(1.5).ok());
  EXPECT_EQ(drama->errors().size(), 1u);
}

TEST_F(DramaTest, TheTemplateIsAGoodDrama) {
  const auto script = ReadText(test::SourceDir() / "lua/template/drama.lua");
  ASSERT_TRUE(script.ok()) << script.message();
  const auto drama = Make(*script);
  PlayTo(*drama, 30.0);
  EXPECT_EQ(FirstError(*drama), "");
  EXPECT_TRUE(State("keeper").visible);
}

TEST_F(DramaTest, TheSeedDecidesTheChances) {
  const auto x_of = [&](uint64_t seed) {
    DramaOptions options;
    options.seed = seed;
    Make("function main() actor('keeper'):place{ x = math.random() } end", options);
    return State("keeper").position.x;
  };
  EXPECT_EQ(x_of(1), x_of(1));
  EXPECT_NE(x_of(1), x_of(2));
}

}  // namespace
}  // namespace lararium::drama
