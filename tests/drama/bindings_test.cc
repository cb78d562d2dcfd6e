// Host functions for objects, speech, expressions and gaze.

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/random.h"
#include "tests/drama/drama_fixture.h"
#include "tests/stage/test_props.h"

namespace lararium::drama {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class WordsTest : public FurnishedDramaTest {
 protected:
  const stage::ObjectState& ObjectState(const char* name) {
    return stage_.Find(*stage_.FindObject(name))->state;
  }
};

constexpr char kScene[] = R"(
  local keeper, guest = actor("keeper"), actor("guest")
  local cup, table_, chest = object("cup"), object("table"), object("chest")
  function main()
    keeper:place{ x = -2, z = -2, heading = 180 }
    guest:place{ x = 2, z = -3, heading = 90 }
    cup:place{ on = table_ }
    together(
      function()
        keeper:take(cup)
        cup:set_state("full")
        keeper:give(cup, guest)
        keeper:use("chest", "open")
        keeper:use(chest, "shut", { seconds = 2 })
      end,
      function()
        guest:look_at(keeper)
        guest:express("joy", 0.5, 0.2)
        guest:say("greeting")
        guest:look_at(nil)
        while cup:holder() ~= guest do wait(0.1) end
        wait(1.5)
        guest:use(cup, "drink")
        guest:put(cup, "table", "top")
      end)
    keeper:walk_to{ x = 0, z = 2, heading = 0 }
    guest:place{ y = cup:state() == "empty" and chest:state() == "shut" and 1 or 2 }
  end
)";

TEST_F(WordsTest, PeopleTakeGiveUseAndPut) {
  const auto drama = Make(kScene);
  PlayTo(*drama, 60.0);
  EXPECT_EQ(FirstError(*drama), "");
  EXPECT_EQ(State("guest").position.y, 1.0f);
  EXPECT_EQ(ObjectState("cup").support.object, *stage_.FindObject("table"));
}

TEST_F(WordsTest, SeekingEqualsPlayingWithObjects) {
  constexpr int kTicks = 45 * Drama::kTicksPerSecond;
  const auto drama = Make(kScene);
  std::vector<stage::StageSnapshot> played = {Snapshot()};
  for (int i = 0; i < kTicks; ++i) {
    drama->Tick();
    played.push_back(Snapshot());
  }
  ASSERT_EQ(FirstError(*drama), "");
  Random random(5);
  for (int i = 0; i < 6; ++i) {
    const uint32_t tick = random.Below(kTicks);
    ASSERT_TRUE(drama->Seek(static_cast<double>(tick) / Drama::kTicksPerSecond).ok());
    EXPECT_TRUE(Snapshot() == played[tick]) << tick;
    drama->Tick();
    EXPECT_TRUE(Snapshot() == played[tick + 1]) << tick;
  }
}

TEST_F(WordsTest, SpeechMovesTheMouthAndTurnsHeads) {
  const auto drama = Make(R"(
    local keeper, guest = actor("keeper"), actor("guest")
    function main()
      keeper:place{ x = 0, z = 0 }
      guest:place{ x = 0, z = -2, heading = 180 }
      wait(1)
      keeper:say("greeting")
      keeper:hide()
    end)");
  PlayTo(*drama, 1.3);
  const human::AnimationState& speaker = State("keeper").animation_state;
  EXPECT_GT(speaker.face.visemes[static_cast<size_t>(human::Viseme::kAa)], 0.5f);
  EXPECT_TRUE(speaker.gaze.speaking);
  const human::Gaze& listener = State("guest").animation_state.gaze;
  EXPECT_EQ(listener.kind, human::GazeKind::kPerson);
  EXPECT_LT(glm::distance(glm::vec2(listener.target.x, listener.target.z), glm::vec2(0.0f)), 0.3f);
  PlayTo(*drama, 1.95);
  EXPECT_TRUE(State("keeper").visible);
  PlayTo(*drama, 2.05);
  EXPECT_FALSE(State("keeper").visible) << "say waits until it is said";
}

TEST_F(WordsTest, LooksGoWhereTheyAreTold) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{ x = 0, z = 0 }
      keeper:look_at("visitor")
      wait(1)
      keeper:look_at{ x = 1, y = 2, z = -3 }
      wait(1)
      keeper:look_at(object("chest"))
      wait(1)
      keeper:look_at(false)
    end)");
  drama->SetVisitor({.tracked = true, .position = {0.5f, 1.7f, -2.0f}});
  PlayTo(*drama, 0.5);
  const human::Gaze& gaze = State("keeper").animation_state.gaze;
  EXPECT_EQ(gaze.kind, human::GazeKind::kPerson);
  EXPECT_EQ(gaze.target, glm::vec3(0.5f, 1.7f, -2.0f));
  drama->SetVisitor({});
  PlayTo(*drama, 0.6);
  EXPECT_EQ(gaze.kind, human::GazeKind::kNothing) << "nobody knows where the visitor is";
  PlayTo(*drama, 1.5);
  EXPECT_EQ(gaze.target, glm::vec3(1.0f, 2.0f, -3.0f));
  PlayTo(*drama, 2.5);
  EXPECT_NEAR(gaze.target.x, 1.5f, 1e-3f);
  PlayTo(*drama, 3.5);
  EXPECT_EQ(gaze.kind, human::GazeKind::kNothing);
}

TEST_F(WordsTest, ByThemselvesPeopleLookAtOthersAndTheVisitorUnlessTheyAreToldNotTo) {
  const auto looks = [&](const char* attention) {
    const auto drama =
        Make(std::string("function main() local k = actor('keeper') k:place{} "
                         "actor('guest'):place{ z = -2, heading = 180 } k:attention(") +
             attention + ") end");
    drama->SetVisitor({.tracked = true, .position = {1.0f, 1.6f, -2.0f}});
    int guest = 0;
    int visitor = 0;
    int nothing = 0;
    for (int tick = 0; tick < 120 * 120; ++tick) {
      drama->Tick();
      const human::Gaze& gaze = State("keeper").animation_state.gaze;
      if (gaze.kind == human::GazeKind::kNothing) {
        ++nothing;
      } else {
        ++(gaze.target.x == 1.0f ? visitor : guest);
      }
    }
    return std::array{guest, visitor, nothing};
  };
  const auto by_itself = looks("true");
  for (const int ticks : by_itself) {
    EXPECT_GT(ticks, 120 * 5);
  }
  EXPECT_EQ(looks("true"), by_itself) << "the same chances every time";
  EXPECT_EQ(looks("false")[2], 120 * 120);
}

TEST_F(WordsTest, AStoppedTaskEndsWithItsLoser) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{ x = -4, z = -4 }
      race(function() keeper:use("chest", "open", { seconds = 60 }) end, function() wait(12) end)
      keeper:walk_to{ x = 3, z = 3 }
      keeper:hide()
    end)");
  PlayTo(*drama, 11.9);
  EXPECT_EQ(ObjectState("chest").action, 0);
  PlayTo(*drama, 25.0);
  EXPECT_EQ(FirstError(*drama), "");
  EXPECT_EQ(ObjectState("chest").action, -1);
  EXPECT_FALSE(State("keeper").visible);
}

TEST_F(WordsTest, EveryTaskIsToldWithItsEnd) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{}
      pcall(keeper.use, keeper, "chest", "shut")
      start(function() attempt(function() wait(1) actor("guest"):take("cup") end) end)
      pcall(function()
        keeper:give("cup", "guest")
      end)
      keeper:take("cup")
      local done, why = attempt(function() keeper:use(object("chest"), "shut") end)
      wait(done and 1000 or 0)
      error(why)
    end)");
  PlayTo(*drama, 30.0);
  ASSERT_EQ(drama->tasks().size(), 6u);
  EXPECT_EQ(drama->tasks()[0].action, "place");
  const auto tasks = drama->tasks().subspan(1);
  EXPECT_EQ(tasks[0].action, "use shut");
  EXPECT_EQ(tasks[0].object, "chest");
  EXPECT_TRUE(tasks[0].failed && !tasks[0].expected);
  EXPECT_EQ(tasks[1].action, "give");
  EXPECT_EQ(tasks[1].where, "drama.lua:8");
  EXPECT_TRUE(tasks[1].failed && !tasks[1].expected) << "of another coroutine than attempt()";
  EXPECT_THAT(tasks[1].message, HasSubstr("does not hold it"));
  for (const size_t i : {size_t{2}, size_t{3}, size_t{4}}) {
    EXPECT_EQ(tasks[i].failed, tasks[i].expected) << tasks[i].action;
    EXPECT_EQ(tasks[i].failed, tasks[i].action != "take" || tasks[i].actor == "guest")
        << tasks[i].message;
    EXPECT_GE(tasks[i].ended, tasks[i].began);
  }
  EXPECT_THAT(FirstError(*drama), HasSubstr("it is 'shut'")) << "attempt() tells why";
  ASSERT_TRUE(drama->Seek(0.0).ok());
  EXPECT_LE(drama->tasks().size(), 2u) << "those until then";
}

TEST_F(WordsTest, AGestureIsPlayedOnceOverWhatTheBodyDoes) {
  const auto drama = Make(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{}
      keeper:play("idle")
      wait(1)
      keeper:gesture("bow")
      keeper:hide()
    end)");
  PlayTo(*drama, 1.1);
  EXPECT_EQ(State("keeper").animation_state.animation.clip, 2);
  EXPECT_EQ(State("keeper").animation_state.animation.part, human::BodyPart::kUpper);
  PlayTo(*drama, 1.4);
  EXPECT_EQ(State("keeper").animation_state.animation.clip, 0);
  EXPECT_TRUE(State("keeper").visible);
  PlayTo(*drama, 1.6);
  EXPECT_FALSE(State("keeper").visible);
}

TEST_F(WordsTest, MistakesAreBlamedOnTheScript) {
  const struct {
    const char* call;
    const char* problem;
  } kMistakes[] = {
      {"object('anvil')", "there is no object 'anvil'"},
      {"actor('keeper'):take('anvil')", "there is no object 'anvil'"},
      {"actor('keeper'):take(actor('guest'))", "give an object"},
      {"actor('keeper'):take('table')", "'table': cannot be carried"},
      {"actor('keeper'):use('chest', 'eat')", "'chest': has no action 'eat'; it has open, shut"},
      {"actor('keeper'):use('chest', 'open')", "'keeper' is not on the stage"},
      {"actor('keeper'):place{} actor('keeper'):use('chest', 'shut')", "it is 'shut'"},
      {"actor('keeper'):place{} actor('keeper'):put('cup', 'table')", "it does not hold it"},
      {"actor('keeper'):place{} actor('keeper'):put('cup', 'table', 'underside')",
       "'table' has no surface 'underside'"},
      {"actor('keeper'):place{} actor('keeper'):give('cup', 'keeper')", "to itself"},
      {"actor('keeper'):give('cup', { id = 1 })", "give: give an actor"},
      {"actor('keeper'):look_at({ id = 1 })", "look_at: x must be"},
      {"visitor:near({ id = 1 }, 1)", "give an actor, an object or a point"},
      {"actor('keeper'):sit('table', 'wipe') actor('keeper'):sit('chest')", "not on the stage"},
      {"actor('keeper'):say('poem')", "there is no line 'poem'; add it to lines.csv"},
      {"actor('keeper'):express('hunger')", "there is no expression 'hunger'"},
      {"actor('keeper'):express('joy', 2)", "between 0 and 1"},
      {"actor('keeper'):gesture('fly')", "has no clip 'fly'"},
      {"actor('keeper'):gesture('bow', 'foot')", "the part must be"},
      {"actor('keeper'):look_at(3)", "give an actor, an object"},
      {"actor('keeper'):gait{ stoop = 90 }", "stoop is out of range"},
      {"object('chest'):set_state('lost')", "'chest' has no state 'lost'; it has shut, open"},
      {"object('cup'):place{ on = 'table', surface = 'top', spot = 9 }", "no such spot"},
      {"object('cup'):place{ x = 0/0 }", "x must be a number"},
  };
  for (const auto& mistake : kMistakes) {
    const auto drama = Make(std::string("function main()\n") + mistake.call + "\nend");
    PlayTo(*drama, 0.5);
    EXPECT_THAT(FirstError(*drama), HasSubstr(mistake.problem)) << mistake.call;
    EXPECT_THAT(FirstError(*drama), StartsWith("drama.lua:2:")) << mistake.call;
  }
}

TEST_F(WordsTest, ATrackedActorTakesNoTasks) {
  const auto drama = Make(R"(
    track{ actor = "keeper", clips = {{ at = 0, length = 4, clip = "idle" }} }
    function main() actor("keeper"):walk_to{ x = 1 } end)");
  EXPECT_THAT(FirstError(*drama), HasSubstr("'keeper' is led by a track"));
}

TEST_F(WordsTest, TheTimeOfDayMovesTheShorterWayAndSeeksBack) {
  const auto drama = Make(R"(
    function main()
      assert(daylight:time() == nil)
      wait(1)
      daylight:set_time(22)
      wait(1)
      daylight:set_time(2, { seconds = 2 })
      wait(1)
      reached = daylight:time()
    end)");
  EXPECT_FALSE(Snapshot().hour);
  PlayTo(*drama, 1.5);
  EXPECT_EQ(Snapshot().hour, 22.0);
  PlayTo(*drama, 3.0);
  EXPECT_NEAR(std::remainder(*Snapshot().hour, 24.0), 0.0, 0.05);  // across midnight
  PlayTo(*drama, 5.0);
  EXPECT_NEAR(*Snapshot().hour, 2.0, 1e-9);
  EXPECT_EQ(FirstError(*drama), "");
  ASSERT_TRUE(drama->Seek(1.5).ok());
  EXPECT_EQ(Snapshot().hour, 22.0);
}

TEST_F(WordsTest, ATimeOfDayThatIsNoneIsAnError) {
  EXPECT_THAT(FirstError(*Make("daylight:set_time(25)")), HasSubstr("set_time: give the hours"));
  EXPECT_THAT(FirstError(*Make("daylight:set_time(5, { seconds = 'x' })")), HasSubstr("seconds"));
}

TEST_F(WordsTest, LightsAreDimmedAndColouredAndSeekBack) {
  Add("lamp", test::MakeLamp(), {});
  const auto drama = Make(R"(
    function main()
      assert(light("lamp"):level() == 1)
      light("lamp"):set{ level = 0.5, seconds = 2 }
      wait(2)
      light(object("lamp")):set{ colour = { 0, 2, 0 } }
      wait(1)
      light("lamp"):set{ level = 0, temperature = 1900 }
    end)");
  PlayTo(*drama, 1.0);
  EXPECT_NEAR(ObjectState("lamp").light.level, 0.75f, 0.01f);
  PlayTo(*drama, 2.5);
  EXPECT_NEAR(ObjectState("lamp").light.level, 0.5f, 1e-5f);
  EXPECT_NEAR(ObjectState("lamp").light.colour.g, 1.0f / 0.7152f, 1e-5f);
  PlayTo(*drama, 3.5);
  EXPECT_EQ(ObjectState("lamp").light.level, 0.0f);
  EXPECT_GT(ObjectState("lamp").light.colour.r, 2.0f);
  EXPECT_EQ(FirstError(*drama), "");
  ASSERT_TRUE(drama->Seek(1.0).ok());
  EXPECT_NEAR(ObjectState("lamp").light.level, 0.75f, 0.01f);
  EXPECT_EQ(ObjectState("lamp").light.colour, glm::vec3(0.0f));
}

TEST_F(WordsTest, LightsThatAreNotThereAreErrors) {
  EXPECT_THAT(FirstError(*Make("light('table')")), HasSubstr("no light in its object file"));
  EXPECT_THAT(FirstError(*Make("light(3)")), HasSubstr("give an object"));
  Add("lamp", test::MakeLamp(), {});
  EXPECT_THAT(FirstError(*Make("light('lamp'):set{ level = -1 }")), HasSubstr("level must be"));
  EXPECT_THAT(FirstError(*Make("light('lamp'):set{ colour = 'red' }")), HasSubstr("colour"));
}

}  // namespace
}  // namespace lararium::drama
