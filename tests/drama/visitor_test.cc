// Triggers, actors who react to the visitor, and synchronisation points of actions.

#include <gmock/gmock.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <set>
#include <vector>

#include "shared/drama/sync_points.h"
#include "shared/drama/triggers.h"
#include "tests/drama/drama_fixture.h"
#include "tests/stage/test_props.h"

namespace lararium::drama {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class VisitorTest : public DramaTest {
 protected:
  VisitorTest() {
    EXPECT_TRUE(
        stage_.AddObject("chest", test::Model(test::MakeChest()), {{1.5f, 0.0f, 0.0f}}).ok());
    EXPECT_TRUE(stage_.AddObject("cup", test::Model(test::MakeCup()), {{0.0f, 0.0f, -2.0f}}).ok());
    human::VisemeTrack track;
    track.keys = {{0.0f, human::Viseme::kSil, 1.0f},
                  {0.2f, human::Viseme::kPP, 1.0f},
                  {0.3f, human::Viseme::kAa, 1.0f},
                  {0.7f, human::Viseme::kOu, 1.0f},
                  {0.9f, human::Viseme::kSil, 1.0f}};
    track.duration = 1.0f;
    EXPECT_TRUE(stage_.AddSpeech("salvete", track).ok());
  }

  // A drama in which `x` of the guest counts how often a trigger fired.
  std::unique_ptr<Drama> Counting(const std::string& trigger) {
    return Make(
        "local n = 0 local keeper, guest = actor('keeper'), actor('guest')\n"
        "keeper:place{} guest:place{}\n"
        "on(" +
        trigger + ", function() n = n + 1 guest:place{ x = n } end)");
  }
  int Count() { return static_cast<int>(State("guest").position.x); }

  // Keeps the visitor at a place, looking at a point, for some seconds.
  static void Be(Drama& drama, const glm::vec3& position, const glm::vec3& at, double seconds) {
    drama.SetVisitor(
        {.tracked = true, .position = position, .direction = glm::normalize(at - position)});
    PlayTo(drama, drama.time() + seconds);
  }
};

constexpr glm::vec3 kFar = {5.0f, 1.6f, 0.0f};
constexpr glm::vec3 kNear = {1.0f, 1.6f, 0.0f};
constexpr glm::vec3 kBetween = {1.65f, 1.6f, 0.0f};
constexpr glm::vec3 kKeeper = {0.0f, 1.2f, 0.0f};
constexpr glm::vec3 kAway = {5.0f, 1.6f, 9.0f};

TEST_F(VisitorTest, NearFiresOnceForEachComing) {
  const auto drama = Counting("visitor:near('keeper', 1.5, {leave = 1.8})");
  Be(*drama, kFar, kKeeper, 0.2);
  EXPECT_EQ(Count(), 0);
  for (int i = 0; i < 5; ++i) {
    Be(*drama, kNear, kKeeper, 0.2);
    Be(*drama, kBetween, kKeeper, 0.2);
  }
  EXPECT_EQ(Count(), 1) << "to and fro at the border counts once";
  Be(*drama, kFar, kKeeper, 0.2);
  Be(*drama, kNear, kKeeper, 0.2);
  EXPECT_EQ(Count(), 2);
  drama->SetVisitor({});
  PlayTo(*drama, drama->time() + 1.0);
  Be(*drama, kNear, kKeeper, 0.2);
  EXPECT_EQ(Count(), 2) << "who is lost has not gone";
}

TEST_F(VisitorTest, LeavesFiresOnGoingOnly) {
  const auto drama = Counting("visitor:leaves('keeper', 1.5)");
  Be(*drama, kFar, kKeeper, 0.3);
  EXPECT_EQ(Count(), 0) << "who was never there cannot leave";
  Be(*drama, kNear, kKeeper, 0.3);
  Be(*drama, kBetween, kKeeper, 0.3);
  EXPECT_EQ(Count(), 0);
  Be(*drama, kFar, kKeeper, 0.3);
  EXPECT_EQ(Count(), 1);
}

TEST_F(VisitorTest, LooksAtNeedsATimeAndForgivesAGlanceElsewhere) {
  const auto drama = Counting("visitor:looks_at('keeper', {angle = 8, seconds = 0.5})");
  Be(*drama, kFar, kKeeper, 0.4);
  Be(*drama, kFar, kAway, 0.4);
  Be(*drama, kFar, kKeeper, 0.4);
  EXPECT_EQ(Count(), 0);
  Be(*drama, kFar, kKeeper, 0.3);
  EXPECT_EQ(Count(), 1);
  Be(*drama, kFar, kAway, 0.2);
  Be(*drama, kFar, kKeeper, 1.0);
  EXPECT_EQ(Count(), 1) << "a glance";
  Be(*drama, kFar, kAway, 0.5);
  Be(*drama, kFar, kKeeper, 1.0);
  EXPECT_EQ(Count(), 2);
}

TEST_F(VisitorTest, LookingIsMeasuredByTheAngleToThePerson) {
  // The target is 5 m away. A look that misses it by 7 degrees counts, one that misses by 9 does
  // not.
  for (const auto& [degrees, expected] : {std::pair(7.0, 1), std::pair(9.0, 0)}) {
    const auto drama = Counting("visitor:looks_at('keeper', {angle = 8})");
    const auto aside = static_cast<float>(5.0 * std::tan(degrees / 180.0 * M_PI));
    const float eyes = stage_.Find(*stage_.Find("keeper"))->eye_height();
    Be(*drama, {5.0f, eyes, 0.0f}, {0.0f, eyes, aside}, 1.0);
    EXPECT_EQ(Count(), expected) << degrees;
  }
}

TEST_F(VisitorTest, LooksAwayFiresAfterLooking) {
  const auto drama = Counting("visitor:looks_away('keeper', {seconds = 1})");
  Be(*drama, kFar, kAway, 2.0);
  EXPECT_EQ(Count(), 0);
  Be(*drama, kFar, kKeeper, 0.5);
  Be(*drama, kFar, kAway, 0.8);
  EXPECT_EQ(Count(), 0);
  Be(*drama, kFar, kAway, 0.4);
  EXPECT_EQ(Count(), 1);
}

TEST_F(VisitorTest, StaysFiresWhereverTheyStand) {
  const auto drama = Counting("visitor:stays(1)");
  for (int i = 0; i < 10; ++i) {
    Be(*drama, kFar + glm::vec3(0.5f * static_cast<float>(i), 0.0f, 0.0f), kKeeper, 0.3);
  }
  EXPECT_EQ(Count(), 0) << "walks";
  Be(*drama, kNear, kKeeper, 3.0);
  EXPECT_EQ(Count(), 1);
  const auto at = Counting("visitor:stays(1, {at = {x = 1, z = 0}, metres = 0.5})");
  Be(*at, kFar, kKeeper, 3.0);
  EXPECT_EQ(Count(), 0);
  Be(*at, kNear, kKeeper, 1.2);
  EXPECT_EQ(Count(), 1);
}

TEST_F(VisitorTest, TrackingKeysClockAndTimeoutsFire) {
  const auto lost = Counting("tracking('lost', 0.5)");
  Be(*lost, kNear, kKeeper, 0.2);
  lost->SetVisitor({});
  PlayTo(*lost, 0.6);
  EXPECT_EQ(Count(), 0);
  PlayTo(*lost, 2.0);
  EXPECT_EQ(Count(), 1);
  const auto back = Counting("tracking('back', 0.5)");
  PlayTo(*back, 1.0);
  Be(*back, kNear, kKeeper, 0.2);
  EXPECT_EQ(Count(), 1);
  const auto key = Counting("key('space')");
  key->SetVisitor({.keys = "a space"});
  PlayTo(*key, 0.5);
  EXPECT_EQ(Count(), 1) << "a key counts in one tick";
  key->SetVisitor({.keys = "spac"});
  PlayTo(*key, 0.6);
  EXPECT_EQ(Count(), 1);
  const auto clock = Counting("clock('9:30')");
  for (const float hour : {9.4f, 9.49f, 9.51f, 9.6f, 10.0f}) {
    clock->SetVisitor({.hour = hour});
    PlayTo(*clock, clock->time() + 0.1);
    EXPECT_EQ(Count(), hour > 9.5f ? 1 : 0) << hour;
  }
  const auto once = Counting("timeout(0.5)");
  PlayTo(*once, 0.49);
  EXPECT_EQ(Count(), 0);
  PlayTo(*once, 3.0);
  EXPECT_EQ(Count(), 1);
}

TEST_F(VisitorTest, FirstTellsWhichAndWaitForWaits) {
  const auto drama = Make(R"(
    local guest = actor("guest")
    function main()
      guest:place{ x = first(visitor:near({x = 9, z = 9}), timeout(1), timeout(2)) }
      wait_for(key("a"))
      guest:place{ z = now() }
    end)");
  PlayTo(*drama, 1.5);
  EXPECT_EQ(State("guest").position.x, 2.0f);
  drama->SetVisitor({.keys = "a"});
  PlayTo(*drama, 2.0);
  EXPECT_NEAR(State("guest").position.z, 1.5f, 0.02f);
  EXPECT_EQ(FirstError(*drama), "");
}

TEST_F(VisitorTest, AnAuthorSaysWhenTheStoryIsTold) {
  EXPECT_EQ(Make("function main() end")->settings().length, 0.0) << "nobody said";
  EXPECT_EQ(Make("drama{length = 235} function main() end")->settings().length, 235.0);
  const auto wrong = Make("drama{length = -1} function main() end");
  EXPECT_NE(FirstError(*wrong), "");
}

TEST_F(VisitorTest, TheDramaHoldsWhereItsAuthorWantsThat) {
  const auto holds = Make("drama{ when_lost = 'hold', patience = 0.5 } function main() end");
  Be(*holds, kNear, kKeeper, 1.0);
  EXPECT_FALSE(holds->holds());
  holds->SetVisitor({});
  PlayTo(*holds, 1.4);
  EXPECT_FALSE(holds->holds()) << "has patience";
  PlayTo(*holds, 1.6);
  EXPECT_TRUE(holds->holds());
  holds->SetVisitor({.tracked = true});
  EXPECT_FALSE(holds->holds());
  const auto goes_on = Make("function main() end");
  PlayTo(*goes_on, 3.0);
  EXPECT_FALSE(goes_on->holds());
}

TEST_F(VisitorTest, PeopleGreetAndAddressTheVisitor) {
  const auto drama = Make(R"(
    local keeper, guest = actor("keeper"), actor("guest")
    function main()
      keeper:place{ heading = 0 }
      wait(0.1)
      keeper:greet{ say = "salvete", gesture = "bow" }
      guest:place{ x = -9, z = 9 }
      guest:place{ y = keeper:address("salvete") and 1 or 2 }
      wait(3)
      guest:place{ y = keeper:address("salvete", {patience = 1}) and 1 or 2 }
    end)");
  Be(*drama, {0.0f, 1.6f, 4.0f}, {0.0f, 1.6f, 9.0f}, 2.0);
  EXPECT_EQ(State("keeper").animation_state.gaze.target, glm::vec3(0.0f, 1.6f, 4.0f));
  Be(*drama, {0.0f, 1.6f, 4.0f}, {0.0f, 1.6f, 9.0f}, 4.0);
  EXPECT_NEAR(std::abs(State("keeper").heading), M_PI, 0.05) << "faces them";
  EXPECT_TRUE(State("guest").visible);
  EXPECT_EQ(State("guest").position.y, 0.0f) << "waits until they look";
  Be(*drama, {0.0f, 1.6f, 4.0f}, kKeeper, 2.5);
  EXPECT_EQ(State("guest").position.y, 1.0f);
  Be(*drama, {0.0f, 1.6f, 4.0f}, {0.0f, 1.6f, 9.0f}, 5.0);
  EXPECT_EQ(State("guest").position.y, 2.0f) << "has no patience left";
  EXPECT_EQ(FirstError(*drama), "");
}

TEST_F(VisitorTest, WhoIsCrowdedStepsAsideAndComesBack) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{ heading = 90 }
      keeper:keep_distance(0.8)
    end)");
  Be(*drama, {3.0f, 1.6f, 0.0f}, kKeeper, 1.0);
  EXPECT_EQ(State("keeper").position.x, 0.0f);
  Be(*drama, {0.4f, 1.6f, 0.0f}, kKeeper, 5.0);
  EXPECT_GT(glm::distance(State("keeper").position, glm::vec3(0.4f, 0.0f, 0.0f)), 1.0f);
  Be(*drama, {4.0f, 1.6f, 0.0f}, kKeeper, 8.0);
  EXPECT_LT(glm::length(State("keeper").position), 0.02f);
  EXPECT_NEAR(State("keeper").heading, M_PI / 2.0, 0.02);
  EXPECT_EQ(FirstError(*drama), "");
}

// ---- points -----------------------------------------------------------------

TEST(SyncTimes, TheStrokeOfAGestureIsWhereItIsFurthestFromItsBeginning) {
  human::Skeleton skeleton;
  skeleton.names = {"arm"};
  skeleton.parents = {human::Skeleton::kNoParent};
  human::Clip clip;
  clip.keys_per_second = 10.0f;
  clip.duration = 3.0f;
  // Rises for 1 s, stays near the top for 1 s with the peak in the middle, sinks for 1 s.
  for (int key = 0; key <= 30; ++key) {
    const float t = static_cast<float>(key) / 10.0f;
    const float angle = t < 1.0f   ? t
                        : t < 2.0f ? 1.0f + 0.1f * (0.5f - std::abs(t - 1.5f))
                                   : 3.0f - t;
    clip.keys.push_back({glm::angleAxis(angle, glm::vec3(1.0f, 0.0f, 0.0f))});
  }
  const SyncTimes times = GestureTimes(clip, human::TurnedFromFirst(clip, skeleton.size()), 0.3);
  const double expected[] = {0.0, 0.3, 0.9, 1.5, 2.1, 2.7, 3.0};
  for (size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(times[i], expected[i], 0.101) << i;
    EXPECT_TRUE(i == 0 || times[i] >= times[i - 1]);
  }
}

TEST_F(VisitorTest, SpeechIsStrokedWhereItsLongestVowelIs) {
  const SyncTimes times = SpeechTimes(stage_.SpeechTrack(*stage_.FindSpeech("salvete")));
  const double expected[] = {0.0, 0.2, 0.2, 0.5, 0.9, 0.9, 1.0};
  for (size_t i = 0; i < times.size(); ++i) {
    EXPECT_NEAR(times[i], expected[i], 1e-6) << i;
  }
}

TEST_F(VisitorTest, OthersMayBeginAtAnyPointOfWhatSomebodyDoes) {
  const auto drama = Make(R"(
    local keeper, guest = actor("keeper"), actor("guest")
    function main()
      guest:place{}
      keeper:place{ x = 0, z = -1 }
      local line = start(keeper.say, keeper, "salvete")
      at(line, "stroke", function() guest:place{ x = now() } end)
      at(line, "stroke", -0.25, function() guest:place{ y = now() } end)
      after(line, function() guest:place{ z = now() } end)
      local done, why = wait_for(line)
      local takes = start(function() keeper:take("cup") end)
      at(takes, "relax", function()
        guest:place{ heading = object("cup"):holder() == keeper and not takes:is_over() and 90 or 0 }
      end)
      wait_for(takes)
      done, why = wait_for(start(keeper.take, keeper, "chest"))
      keeper:place{ y = done and 1 or 2 }
    end)");
  PlayTo(*drama, 1.5);
  EXPECT_NEAR(State("guest").position.x, 0.5f, 0.01f);
  EXPECT_NEAR(State("guest").position.y, 0.25f, 0.01f);
  EXPECT_NEAR(State("guest").position.z, 1.0f, 0.02f);
  PlayTo(*drama, 20.0);
  EXPECT_NEAR(State("guest").heading, M_PI / 2.0, 1e-5) << "between taking and having taken";
  EXPECT_EQ(State("keeper").position.y, 2.0f) << "failures come back as values";
  EXPECT_THAT(FirstError(*drama), StartsWith("drama.lua:16:")) << "and are told";
}

TEST_F(VisitorTest, PointsOfAUseComeInTheirOrder) {
  const auto drama = Make(R"(
    local keeper, guest = actor("keeper"), actor("guest")
    function main()
      guest:place{}
      keeper:place{ x = -1, z = 0 }
      local use = start(keeper.use, keeper, "chest", "open")
      for i, point in ipairs{"start", "ready", "stroke_start", "stroke", "stroke_end", "relax", "end"} do
        wait_for(use, point)
        guest:place{ x = i, z = -now() }
        if point == "stroke_start" then guest:place{ y = object("chest"):state() == "shut" and 1 or 2 } end
      end
    end)");
  float last = 0.0f;
  for (int i = 0; i < 20 * 120; ++i) {
    drama->Tick();
    const glm::vec3 at = State("guest").position;
    EXPECT_LE(at.z, last);
    last = at.z;
  }
  EXPECT_EQ(State("guest").position.x, 7.0f);
  EXPECT_EQ(State("guest").position.y, 1.0f);
  EXPECT_LT(last, -1.0f);
  EXPECT_EQ(FirstError(*drama), "");
}

TEST_F(VisitorTest, PointsOfSeveralPeopleMeet) {
  const auto drama = Make(R"(
    local keeper, guest = actor("keeper"), actor("guest")
    function main()
      keeper:place{} guest:place{ z = -2 }
      local done = meet("stroke", {keeper, "gesture", "bow"},
                        {guest, "say", "salvete", point = "end"})
      keeper:place{ y = done and now() or 9 }
    end)");
  const auto tasks_of = [&](const char* action) {
    for (const TaskRecord& task : drama->tasks()) {
      if (task.action.starts_with(action)) {
        return task;
      }
    }
    return TaskRecord();
  };
  PlayTo(*drama, 5.0);
  const stage::Actor& keeper = *stage_.Find(*stage_.Find("keeper"));
  const SyncTimes bow = GestureTimes(keeper.human().clips[2], keeper.model->turned[2], 0.3);
  EXPECT_NEAR(tasks_of("gesture").began + bow[3], tasks_of("say").began + 1.0, 0.02);
  EXPECT_EQ(FirstError(*drama), "");
  EXPECT_LT(State("keeper").position.y, 5.0f);
}

TEST_F(VisitorTest, TogetherAndRaceTellHowTheyEnded) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{}
      local done, why = together(function() end, function() keeper:take("chest") end)
      keeper:place{ x = done and 9 or 1, z = why:find("cannot be carried") and 1 or 9 }
      keeper:place{ y = race(function() wait(2) end, function() wait(1) end, function() wait(3) end) }
    end)");
  PlayTo(*drama, 4.0);
  EXPECT_EQ(State("keeper").position, glm::vec3(1.0f, 2.0f, 1.0f));
}

TEST_F(VisitorTest, WhatTheScriptDidIsToldAsBlocks) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{}
      wait(0.5)
      keeper:say("salvete")
      keeper:gesture("bow")
      keeper:walk_to{ x = 1 }
    end)");
  PlayTo(*drama, 10.0);
  ASSERT_EQ(drama->tasks().size(), 4u);
  EXPECT_EQ(drama->tasks()[0].action, "place");
  const auto tasks = drama->tasks().subspan(1);
  EXPECT_EQ(tasks[0].action, "say salvete");
  EXPECT_EQ(tasks[0].where, "drama.lua:6");
  EXPECT_NEAR(tasks[0].began, 0.5, 1e-9);
  EXPECT_NEAR(tasks[0].ended, 1.5, 1e-9);
  EXPECT_EQ(tasks[1].action, "gesture bow");
  EXPECT_EQ(tasks[2].action, "walk_to");
  EXPECT_EQ(tasks[2].actor, "keeper");
}

TEST_F(VisitorTest, WrongWordsAreBlamedOnTheScript) {
  const struct {
    const char* call;
    const char* problem;
  } kMistakes[] = {
      {"on(3, print)", "give a trigger"},
      {"on(timeout(1), 3)", "give functions"},
      {"visitor:near('nobody')", "there is no actor or object called 'nobody'"},
      {"visitor:near('keeper', -1)", "the distance must be a number"},
      {"visitor:looks_at('keeper', {angle = 200})", "angle must be a number"},
      {"clock('25:00')", "give a time like"},
      {"tracking('found')", "give \"lost\" or \"back\""},
      {"key()", "give the name of a key"},
      {"timeout('x')", "give a number of seconds"},
      {"wait_for(3)", "give what start gave"},
      {"wait_for(start(function() wait(1) end), 'middle')", "there is no point 'middle'"},
      {"meet('stroke', {actor('keeper'), 'walk_to'})", "give a point and things like"},
      {"meet('stroke', {{id = actor('keeper').id}, 'gesture', 'bow'})", "meet: give an actor"},
      {"meet('stroke', {object('chest'), 'gesture', 'bow'})", "meet: give an actor"},
      {"drama{}", "only while the script loads"},
      {"actor('keeper'):keep_distance(99)", "must be a number from"},
      {"first(1)", "give triggers like"},
  };
  for (const auto& mistake : kMistakes) {
    const auto drama = Make(std::string("function main()\n") + mistake.call + "\nend");
    PlayTo(*drama, 0.5);
    EXPECT_THAT(FirstError(*drama), HasSubstr(mistake.problem)) << mistake.call;
    EXPECT_THAT(FirstError(*drama), StartsWith("drama.lua:2:")) << mistake.call;
  }
}

TEST_F(VisitorTest, MessagesFireByAddressAndFirstArgument) {
  const auto fires = [&](const std::string& trigger, const std::string& keys) {
    const auto drama = Counting(trigger);
    drama->SetVisitor({.keys = keys});
    PlayTo(*drama, 1.0);
    EXPECT_EQ(FirstError(*drama), "");
    return Count();
  };
  EXPECT_EQ(fires("osc('/door')", "/door,1"), 1);
  EXPECT_EQ(fires("osc('/door')", "/door"), 1);
  EXPECT_EQ(fires("osc('/door')", "/doors a /do"), 0);
  EXPECT_EQ(fires("osc('/door', 1)", "/door,1,2"), 1);
  EXPECT_EQ(fires("osc('/door', 1)", "/door,10"), 0);
  EXPECT_EQ(fires("osc('/door', 0.1)", "/door,0.1"), 1);
  EXPECT_EQ(fires("osc('/door', 'an oak')", "/door," + MessageText("an oak")), 1);
  EXPECT_EQ(fires("osc('/door', true)", "/door,T"), 1);
  EXPECT_EQ(fires("key('a')", "/a a"), 1);
}

TEST_F(VisitorTest, WhatTheLastMessageSaidIsKeptAndSought) {
  const auto drama = Make(R"(
    local guest = actor("guest")
    guest:place{}
    on(osc("/at"), function()
      local x, who, yes, nothing = heard("/at")
      assert(who == "guest, or" and yes == true and nothing == nil)
      guest:place{x = x}
    end)
    assert(heard("/at") == nil)
  )");
  PlayTo(*drama, 1.0);
  drama->SetVisitor({.keys = "/at,3.5," + MessageText("guest, or") + ",T,N"});
  PlayTo(*drama, 5.0);
  EXPECT_EQ(FirstError(*drama), "");
  EXPECT_EQ(State("guest").position.x, 3.5f);
  ASSERT_TRUE(drama->Seek(0.5).ok());
  EXPECT_EQ(State("guest").position.x, 0.0f);
  // Its log, read again, gives the same drama.
  ASSERT_TRUE(drama->Seek(5.0).ok());
  EXPECT_EQ(State("guest").position.x, 3.5f);
  auto log = VisitorLog::Read(drama->visitor_log().Write(), "log");
  ASSERT_TRUE(log.ok()) << log.message();
  drama->SetVisitorLog(*std::move(log));
  ASSERT_TRUE(drama->Seek(0.5).ok());
  ASSERT_TRUE(drama->Seek(4.0).ok());
  EXPECT_EQ(State("guest").position.x, 3.5f);
}

TEST(VisitorKeys, MoreThanALogKeepsAreNotHeard) {
  std::string keys;
  for (int i = 0; i < 10'000; ++i) {
    AddKey("space", keys);
  }
  EXPECT_LE(keys.size(), kMaxKeyBytes);
  VisitorLog log;
  log.Set(0, {.keys = keys});
  EXPECT_TRUE(VisitorLog::Read(log.Write(), "log").ok());
}

TEST(VisitorKeys, TextsOfMessagesComeBackAsTheyWere) {
  for (const char* text : {"", "oak", "an oak, 100 %", "v\xC4\xABnum\n", "'"}) {
    EXPECT_EQ(ReadMessageText(MessageText(text)), text);
  }
  EXPECT_FALSE(ReadMessageText("oak").has_value());
  EXPECT_FALSE(ReadMessageText("'%4").has_value());
  EXPECT_FALSE(ReadMessageText("'%zz").has_value());
}

// ---- several visitors

Visitor Group(std::vector<GroupVisitor> visitors) {
  return {.group = std::make_shared<const std::vector<GroupVisitor>>(std::move(visitors))};
}
GroupVisitor One(int number, const glm::vec3& position, const glm::vec3& at) {
  return {number, true, position, glm::normalize(at - position)};
}

TEST_F(VisitorTest, AnyVisitorOfAGroupFiresATrigger) {
  const GroupVisitor away = One(0, kAway, kFar);
  for (const char* trigger : {"visitor:near('keeper', 1.5)", "visitor:looks_at('keeper')",
                              "visitor:stays(1, {at = 'keeper', metres = 1.5})"}) {
    const auto drama = Counting(trigger);
    drama->SetVisitor(Group({away, One(1, kFar, kAway)}));
    PlayTo(*drama, 0.5);
    EXPECT_EQ(Count(), 0) << trigger;
    drama->SetVisitor(Group({away, One(1, kNear, kKeeper)}));
    PlayTo(*drama, 2.5);
    EXPECT_EQ(Count(), 1) << trigger;
    GroupVisitor lost = One(1, kNear, kKeeper);
    lost.tracked = false;
    drama->SetVisitor(Group({away, lost}));
    PlayTo(*drama, 5.0);
    EXPECT_EQ(Count(), 1) << trigger;
  }
}

TEST_F(VisitorTest, EachVisitorOfAGroupStaysForThemselves) {
  const auto drama = Counting("visitor:stays(2)");
  // The first visitor moves all the time, the second comes after a second.
  for (int i = 0; i < 10; ++i) {
    const float step = static_cast<float>(i);
    drama->SetVisitor(
        Group({One(0, {5.0f + step, 1.6f, 0.0f}, kKeeper), One(4, i < 5 ? kFar : kNear, kKeeper)}));
    PlayTo(*drama, 0.3 * (i + 1));
  }
  EXPECT_EQ(Count(), 0);
  PlayTo(*drama, 5.0);
  EXPECT_EQ(Count(), 2) << "both, once each";
}

TEST_F(VisitorTest, OfAGroupTheNearestIsMeasuredAndAllHaveToBeLost) {
  const auto drama = Make(R"(
    local keeper, guest = actor("keeper"), actor("guest")
    keeper:place{} guest:place{}
    on(tracking("lost", 0.5), function() guest:place{ x = 50 } end)
    function main() wait(1) guest:place{ x = visitor:distance(keeper) } end
  )");
  drama->SetVisitor(Group({One(0, kFar, kKeeper), One(1, kNear, kKeeper)}));
  PlayTo(*drama, 2.0);
  EXPECT_FLOAT_EQ(State("guest").position.x, 1.0f);
  GroupVisitor lost = One(1, kNear, kKeeper);
  lost.tracked = false;
  drama->SetVisitor(Group({One(0, kFar, kKeeper), lost}));
  PlayTo(*drama, 4.0);
  EXPECT_FLOAT_EQ(State("guest").position.x, 1.0f);
  drama->SetVisitor(Group({lost}));
  PlayTo(*drama, 6.0);
  EXPECT_FLOAT_EQ(State("guest").position.x, 50.0f);
}

TEST_F(VisitorTest, ActorsLookAtTheVisitorsOfAGroupInTurnAndNotAtTheSameOne) {
  const auto drama = Make(R"(
    for _, name in ipairs{"keeper", "guest"} do
      actor(name):place{}
      actor(name):look_at("visitor")
    end
  )");
  const std::vector<glm::vec3> places = {
      {1.0f, 1.6f, -3.0f}, {0.0f, 1.6f, -3.0f}, {-1.0f, 1.6f, -3.0f}};
  drama->SetVisitor(
      Group({One(0, places[0], kKeeper), One(1, places[1], kKeeper), One(7, places[2], kKeeper)}));
  const auto looked_at = [&](const char* name) {
    return std::find(places.begin(), places.end(), State(name).animation_state.gaze.target) -
           places.begin();
  };
  std::set<std::ptrdiff_t> by_keeper;
  for (double time = 3.0; time < 20.0; time += 6.0) {
    PlayTo(*drama, time);
    ASSERT_LT(looked_at("keeper"), 3);
    EXPECT_EQ(looked_at("guest"), (looked_at("keeper") + 1) % 3);
    by_keeper.insert(looked_at("keeper"));
  }
  EXPECT_EQ(by_keeper.size(), 3u) << "each in turn";
}

TEST_F(VisitorTest, WhoIsLostIsLookedAtUntilTheTurnEndsAndWhoComesWaits) {
  const auto drama = Make("actor('keeper'):place{} actor('keeper'):look_at('visitor')");
  GroupVisitor first = One(0, kNear, kKeeper);
  const auto target = [&] { return State("keeper").animation_state.gaze.target; };
  drama->SetVisitor(Group({first}));
  PlayTo(*drama, 1.0);
  EXPECT_EQ(target(), kNear);
  first.tracked = false;
  drama->SetVisitor(Group({first, One(1, kFar, kKeeper)}));
  PlayTo(*drama, 5.9);
  EXPECT_EQ(target(), kNear);
  PlayTo(*drama, 6.1);
  EXPECT_EQ(target(), kFar);
}

}  // namespace
}  // namespace lararium::drama
