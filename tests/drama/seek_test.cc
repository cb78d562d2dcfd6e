// Seeking restores the stage of any moment, no matter what happened in between.

#include <gmock/gmock.h>
#include <malloc.h>

#include "shared/core/random.h"
#include "tests/drama/drama_fixture.h"
#include "tests/stage/test_props.h"

namespace lararium::drama {
namespace {

using ::testing::HasSubstr;

class SeekingTest : public FurnishedDramaTest {
 protected:
  // Plays a number of seconds and records each tick.
  std::vector<stage::StageSnapshot> Play(Drama& drama, int seconds) {
    std::vector<stage::StageSnapshot> played = {Snapshot()};
    for (int i = 0; i < seconds * Drama::kTicksPerSecond; ++i) {
      drama.Tick();
      played.push_back(Snapshot());
    }
    return played;
  }
};

constexpr char kBusy[] = R"(
  local keeper, guest = actor("keeper"), actor("guest")
  track{ actor = "guest", speech = {{at = 3, line = "greeting"}, {at = 21, line = "greeting"}},
    expressions = {{at = 5, length = 4, expression = "joy"}},
    gaze = {{at = 2, length = 9, target = "keeper"}} }
  track{ markers = {{at = 12, name = "noon"}} }
  local noons = 0
  on(marker("noon"), function() noons = noons + 1 guest:gesture("bow") end)
  on(visitor:near("keeper", 2), function()
    start(keeper.say, keeper, "greeting")
    wait(math.random())
  end)
  keeper:keep_distance(0.9)
  function main()
    keeper:place{ x = -2, z = -2, heading = 180 }
    guest:place{ x = 2, z = -3, heading = 90 }
    start(function()
      while true do
        attempt(function() guest:walk_to{ x = math.random(-4, 4), z = math.random(-4, 4) } end)
        wait(math.random())
      end
    end)
    while true do
      attempt(function()
        keeper:take("cup")
        local opens = start(keeper.use, keeper, "chest", "open")
        at(opens, "stroke", function() guest:express("surprise", 1, 0.1) end)
        wait_for(opens)
        keeper:put("cup", "table", "top")
        keeper:use("chest", "shut")
      end)
      keeper:walk_to{ x = math.random(-3, 3), z = 2 }
      if noons > 0 then object("table"):place{ x = -1.5 - 0.1 * math.random(), z = 0.3 } end
    end
  end
)";

// The visitor comes, stays, looks about; tracking is lost and comes back.
Visitor VisitorAt(double time) {
  Visitor visitor;
  visitor.tracked = std::fmod(time, 13.0) < 11.0;
  visitor.position = {2.5f * std::sin(0.4f * static_cast<float>(time)), 1.6f,
                      -1.0f + 2.0f * std::cos(0.3f * static_cast<float>(time))};
  visitor.direction = {std::sin(static_cast<float>(time)), 0.0f,
                       -std::cos(static_cast<float>(time))};
  return visitor;
}

TEST_F(SeekingTest, EqualsPlayingBitForBitWhateverHappens) {
  constexpr int kSeconds = 40;
  DramaOptions options;
  options.past = Past::kRepeated;
  const auto drama = Make(kBusy, options);
  std::vector<stage::StageSnapshot> played = {Snapshot()};
  for (int i = 1; i <= kSeconds * Drama::kTicksPerSecond; ++i) {
    drama->SetVisitor(VisitorAt(drama->time()));
    drama->Tick();
    played.push_back(Snapshot());
  }
  const size_t errors = drama->errors().size();
  const size_t tasks = drama->tasks().size();
  EXPECT_GT(tasks, 20u);
  Random random(11);
  for (int i = 0; i < 100; ++i) {
    const uint32_t tick = random.Below(kSeconds * Drama::kTicksPerSecond);
    ASSERT_TRUE(drama->Seek(static_cast<double>(tick) / Drama::kTicksPerSecond).ok());
    ASSERT_TRUE(Snapshot() == played[tick]) << "tick " << tick;
    if (i % 10 == 0) {
      const size_t end = std::min<size_t>(tick + 400, played.size() - 1);
      for (size_t t = tick + 1; t <= end; ++t) {
        drama->Tick();
        ASSERT_TRUE(Snapshot() == played[t]) << "tick " << t << " after a seek to " << tick;
      }
    }
  }
  ASSERT_TRUE(drama->Seek(kSeconds).ok());
  EXPECT_EQ(drama->errors().size(), errors);
  EXPECT_EQ(drama->tasks().size(), tasks);
}

TEST_F(SeekingTest, PlaysNothingAgainThatWasPlayed) {
  const auto drama = Make(kBusy);
  Play(*drama, 40);
  const auto played = drama->played_ticks();
  for (const double time : {39.9, 0.1, 20.5, 3.99, 31.0}) {
    const auto before = drama->played_ticks();
    ASSERT_TRUE(drama->Seek(time).ok());
    EXPECT_LE(drama->played_ticks() - before, 2 * Drama::kTicksPerSecond) << time;
  }
  EXPECT_EQ(played, 40 * Drama::kTicksPerSecond);
}

TEST_F(SeekingTest, AForgottenPastIsPlayedAgainFromTheBeginning) {
  DramaOptions options;
  options.past = Past::kForgotten;
  const auto drama = Make(kBusy, options);
  const auto played = Play(*drama, 20);
  EXPECT_TRUE(drama->tasks().empty());
  for (const uint32_t tick : {700u, 0u, 2'000u, 1'999u}) {
    ASSERT_TRUE(drama->Seek(static_cast<double>(tick) / Drama::kTicksPerSecond).ok());
    ASSERT_TRUE(Snapshot() == played[tick]) << tick;
  }
  drama->SetVisitor(VisitorAt(1.0));
  drama->Tick();
  EXPECT_TRUE(drama->visitor_log().entries().empty());
}

TEST_F(SeekingTest, AForgottenPastTakesNoMemoryHoweverLongItWas) {
#ifdef LARARIUM_SANITIZED
  GTEST_SKIP() << "the sanitizer keeps the memory";
#endif
  // Growth of memory in ten minutes, after a first minute; bytes.
  const auto growth = [&](Past past) {
    DramaOptions options;
    options.past = past;
    const auto drama = Make(kBusy, options);
    const auto play = [&](int minutes) {
      for (int i = 0; i < minutes * 60 * Drama::kTicksPerSecond; ++i) {
        drama->SetVisitor(VisitorAt(drama->time()));
        drama->Tick();
      }
      return static_cast<double>(mallinfo2().uordblks + mallinfo2().hblkhd);
    };
    const double before = play(1);
    return play(10) - before;
  };
  EXPECT_LT(growth(Past::kForgotten), 200'000.0) << "of Lua, which clears up now and then";
  EXPECT_GT(growth(Past::kKept), 2'000'000.0);
}

TEST_F(SeekingTest, AnotherVisitorMakesAnotherFuture) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    on(visitor:near("keeper", 1), function() keeper:place{ x = now() } end)
    function main() keeper:place{} end)");
  Play(*drama, 10);
  ASSERT_TRUE(drama->Seek(4.0).ok());
  drama->SetVisitor({.tracked = true, .position = {0.5f, 1.6f, 0.0f}});
  PlayTo(*drama, 10.0);
  EXPECT_NEAR(State("keeper").position.x, 4.0f, 0.05f);
  const auto snapshot = Snapshot();
  ASSERT_TRUE(drama->Seek(2.0).ok());
  ASSERT_TRUE(drama->Seek(10.0).ok());
  EXPECT_TRUE(Snapshot() == snapshot);
}

TEST_F(SeekingTest, AVisitorsLogPlaysTheSameDrama) {
  const auto drama = Make(kBusy);
  for (int i = 0; i < 20 * Drama::kTicksPerSecond; ++i) {
    Visitor visitor = VisitorAt(drama->time());
    visitor.keys = i % 500 == 0 ? "space" : "";
    drama->SetVisitor(visitor);
    drama->Tick();
  }
  const auto snapshot = Snapshot();
  const std::string text = drama->visitor_log().Write();
  auto log = VisitorLog::Read(text, "visitor.txt");
  ASSERT_TRUE(log.ok()) << log.message();
  EXPECT_EQ(log->Write(), text);
  const auto again = Make(kBusy);
  again->SetVisitorLog(*std::move(log));
  PlayTo(*again, 20.0);
  EXPECT_TRUE(Snapshot() == snapshot);
}

TEST_F(SeekingTest, AnotherDramaGoesOnWithWhatTheVisitorDid) {
  const auto play = [](Drama& drama, int from, int to) {
    for (int i = from * Drama::kTicksPerSecond; i < to * Drama::kTicksPerSecond; ++i) {
      drama.SetVisitor(VisitorAt(drama.time()));
      drama.Tick();
    }
  };
  const auto whole = Make(kBusy);
  play(*whole, 0, 30);
  const auto snapshot = Snapshot();
  const std::string log = whole->visitor_log().Write();

  const auto before = Make(kBusy);
  play(*before, 0, 20);
  const auto after = Make(kBusy);
  after->SetPastVisitor(before->visitor_log(), before->time());
  ASSERT_TRUE(after->Seek(before->time()).ok());
  play(*after, 20, 30);
  EXPECT_TRUE(Snapshot() == snapshot);
  EXPECT_EQ(after->visitor_log().Write(), log);
}

TEST_F(SeekingTest, LateNewsOfAVisitorsLogGiveTheStateThatTimelyNewsWouldHaveGiven) {
  const auto drama = Make(kBusy);
  std::vector<VisitorLog::Entry> all;
  for (int64_t tick = 30; tick < 40 * Drama::kTicksPerSecond; tick += 60) {
    all.push_back({tick, VisitorAt(static_cast<double>(tick) / Drama::kTicksPerSecond)});
  }
  drama->SetVisitorLog({});
  // Entries come with delays of up to half a second, some of several at once.
  Random random(5);
  size_t told = 0;
  int64_t late = 0;
  for (int64_t now = 0; now < 40 * Drama::kTicksPerSecond;) {
    const size_t behind = random.Below(3);
    size_t come = told;
    while (come + behind < all.size() &&
           all[come].tick + 60 * static_cast<int64_t>(behind) <= now) {
      ++come;
    }
    if (come > told) {
      late += all[told].tick <= now ? 1 : 0;
      ASSERT_TRUE(
          drama->ReviseVisitorLog(all[told].tick, std::span(all).subspan(told, come - told)).ok());
      told = come;
    }
    now += 10;
    PlayTo(*drama, static_cast<double>(now) / Drama::kTicksPerSecond);
  }
  ASSERT_GT(late, 20);
  if (told < all.size()) {
    ASSERT_TRUE(drama->ReviseVisitorLog(all[told].tick, std::span(all).subspan(told)).ok());
  }
  PlayTo(*drama, 40.0);
  const stage::StageSnapshot revised = Snapshot();
  VisitorLog log;
  for (const VisitorLog::Entry& entry : all) {
    log.Set(entry.tick, entry.visitor);
  }
  const auto timely = Make(kBusy);
  timely->SetVisitorLog(log);
  PlayTo(*timely, 40.0);
  EXPECT_EQ(Snapshot(), revised);
  EXPECT_EQ(drama->errors().size(), timely->errors().size());
}

TEST_F(SeekingTest, AVisitorsLogThatIsNoneIsAnErrorWithItsLine) {
  const std::string header = "lararium visitor 1\n";
  const std::string good = "3 1 0 1.6 0 0 0 -1 9.5 space a\n";
  EXPECT_TRUE(VisitorLog::Read(header + good, "v").ok());
  EXPECT_FALSE(VisitorLog::Read(good, "v").ok());
  for (const char* bad :
       {"3 1 0 1.6 0 0 0 -1 9.5\n", "2 1 0 1 0 0 0 -1 9\n", "4 2 0 1.6 0 0 0 -1 9\n",
        "4 1 0 1.6 0 0 0 0 9\n", "4 1 nan 1.6 0 0 0 -1 9\n", "4 1 0 1.6\n", "x\n", "\n",
        "4 1 1e9 1.6 0 0 0 -1 9\n", "4 1 0 1.6 0 0 0 -1 25\n", "99999999999 1 0 1 0 0 0 -1 9\n"}) {
    const auto log = VisitorLog::Read(header + good + bad, "v");
    ASSERT_FALSE(log.ok()) << bad;
    EXPECT_THAT(log.message(), HasSubstr("v:3")) << bad;
  }
}

TEST_F(SeekingTest, AnotherScriptKeepsTimeAndPose) {
  const std::string before = R"(
    function main() actor("keeper"):place{} actor("keeper"):walk_to{ x = 3 } wait(99) end)";
  const auto drama = Make(before);
  PlayTo(*drama, 2.0);
  const auto snapshot = Snapshot();
  ASSERT_TRUE(drama->Reload(before + " -- a remark").ok());
  EXPECT_EQ(drama->time(), 2.0);
  EXPECT_TRUE(Snapshot() == snapshot);
  EXPECT_FALSE(drama->Reload("function main( end").ok()) << "the old one goes on";
  EXPECT_EQ(drama->time(), 2.0);
  EXPECT_TRUE(Snapshot() == snapshot);
  ASSERT_TRUE(drama->Reload("function main() actor('guest'):place{ x = 4 } end").ok());
  EXPECT_EQ(drama->time(), 2.0);
  EXPECT_FALSE(State("keeper").visible);
  EXPECT_EQ(State("guest").position.x, 4.0f);
}

TEST_F(SeekingTest, ScriptsThatPassALimitAreSoughtToo) {
  DramaOptions options;
  options.instruction_limit = 100'000;
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{}
      start(function() wait(1) while true do keeper:where() end end)
      start(function() wait(2) while true do end end)
      while true do wait(0.5) keeper:place{ x = math.random() } end
    end)",
                          options);
  const auto played = Play(*drama, 8);
  EXPECT_EQ(drama->errors().size(), 2u);
  for (const uint32_t tick : {900u, 10u, 300u, 130u, 600u, 500u}) {
    ASSERT_TRUE(drama->Seek(static_cast<double>(tick) / Drama::kTicksPerSecond).ok());
    EXPECT_TRUE(Snapshot() == played[tick]) << tick;
  }
}

}  // namespace
}  // namespace lararium::drama
