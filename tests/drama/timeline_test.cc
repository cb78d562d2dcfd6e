// Playback of lanes.

#include "shared/drama/timeline.h"

#include <gmock/gmock.h>

#include "tests/drama/drama_fixture.h"
#include "tests/stage/test_props.h"

namespace lararium::drama {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class TimelineTest : public DramaTest {
 protected:
  TimelineTest() {
    EXPECT_TRUE(
        stage_.AddObject("table", test::Model(test::MakeTable()), {{-1.5f, 0.0f, 0.0f}}).ok());
    EXPECT_TRUE(
        stage_.AddObject("chest", test::Model(test::MakeChest()), {{1.5f, 0.0f, 0.0f}}).ok());
    EXPECT_TRUE(stage_.AddObject("cup", test::Model(test::MakeCup()), {{0.0f, 0.0f, -2.0f}}).ok());
    human::VisemeTrack track;
    track.keys = {{0.0f, human::Viseme::kAa, 1.0f}};
    track.duration = 1.0f;
    EXPECT_TRUE(stage_.AddSpeech("salvete", track).ok());
  }
};

constexpr char kAll[] = R"(
  track{ actor = "keeper",
    walks = {{id = "enter", at = 0, from = {x = -2, z = -2, heading = 180}},
             {at = 18, length = 6, to = {x = 2, z = 2, heading = 90}},
             {at = 32, hide = true}},
    uses = {{at = 1, object = "cup", action = "take"},
            {at = 8, object = "cup", action = "put", on = "table", surface = "top"},
            {at = 12, object = "chest", action = "open"}},
    gaze = {{at = 1, length = 2, target = "guest"}},
    expressions = {{at = 2, length = 2, expression = "joy", intensity = 0.8, fade = 0.2}},
    speech = {{at = 3, line = "salvete"}},
    gestures = {{at = 28, clip = "bow"}},
  }
  track{ actor = "guest", walks = {{at = 0, from = {x = 3, z = 3}}} }
  track{ markers = {{at = 5, name = "five"}} }
)";

TEST_F(TimelineTest, LanesArePlayedWithoutAnyScript) {
  const auto drama = Make(kAll);
  EXPECT_TRUE(State("keeper").visible);
  EXPECT_EQ(State("keeper").position.x, -2.0f);
  PlayTo(*drama, 1.5);
  EXPECT_EQ(State("keeper").animation_state.gaze.kind, human::GazeKind::kPerson);
  PlayTo(*drama, 2.5);
  EXPECT_NEAR(State("keeper").animation_state.face.expressions[1], 0.8f, 0.01f);
  PlayTo(*drama, 3.5);
  EXPECT_GT(State("keeper").animation_state.face.visemes[static_cast<size_t>(human::Viseme::kAa)],
            0.5f);
  PlayTo(*drama, 5.0);
  EXPECT_NEAR(State("keeper").animation_state.face.expressions[1], 0.0f, 0.01f);
  PlayTo(*drama, 7.5);
  EXPECT_EQ(stage_.Find(*stage_.FindObject("cup"))->state.holder, *stage_.Find("keeper"));
  PlayTo(*drama, 28.1);
  EXPECT_EQ(FirstError(*drama), "");
  EXPECT_EQ(stage_.Find(*stage_.FindObject("cup"))->state.support.object,
            *stage_.FindObject("table"));
  EXPECT_EQ(stage_.Find(*stage_.FindObject("chest"))->state.state, 1);
  EXPECT_NEAR(State("keeper").position.x, 2.0f, 1e-4f);
  EXPECT_EQ(State("keeper").animation_state.animation.clip, 2);
  PlayTo(*drama, 32.1);
  EXPECT_FALSE(State("keeper").visible);
}

TEST_F(TimelineTest, WhatLanesDidIsToldWithItsTimes) {
  const auto drama = Make(kAll);
  PlayTo(*drama, 33.0);
  int takes = 0;
  for (const TaskRecord& task : drama->tasks()) {
    EXPECT_TRUE(task.from_timeline);
    EXPECT_FALSE(task.failed);
    if (task.action == "take") {
      ++takes;
      EXPECT_EQ(task.object, "cup");
      EXPECT_NEAR(task.began, 1.0, 1e-6);
      EXPECT_GT(task.ended, 2.0);
      EXPECT_THAT(task.where, StartsWith("drama.lua:2"));
    }
  }
  EXPECT_EQ(takes, 1);
  EXPECT_EQ(drama->tasks().size(), 12u);
}

TEST_F(TimelineTest, SeekingAPureTimelineRunsNoScript) {
  const auto drama = Make(kAll);
  std::vector<stage::StageSnapshot> played = {Snapshot()};
  for (int i = 0; i < 33 * Drama::kTicksPerSecond; ++i) {
    drama->Tick();
    played.push_back(Snapshot());
  }
  for (const uint32_t tick : {2000u, 100u, 1500u, 1499u, 2900u, 0u, 700u}) {
    ASSERT_TRUE(drama->Seek(static_cast<double>(tick) / Drama::kTicksPerSecond).ok());
    EXPECT_TRUE(Snapshot() == played[tick]) << tick;
  }
}

TEST_F(TimelineTest, ScriptsWaitForMarkers) {
  const auto drama = Make(std::string(kAll) + R"(
    on(marker("five"), function() actor("guest"):place{ x = now() } end))");
  PlayTo(*drama, 6.0);
  EXPECT_NEAR(State("guest").position.x, 5.0f, 0.01f);
}

TEST_F(TimelineTest, WhatCannotBeDoneIsToldWithItsItemAndTheRestGoesOn) {
  const auto drama = Make(R"(
    track{ actor = "keeper",
      walks = {{at = 0, from = {x = 0, z = 1}}, {at = 3, to = {x = 1, z = 1}}},
      uses = {{id = "shut it", at = 1, object = "chest", action = "shut"}} })");
  PlayTo(*drama, 8.0);
  EXPECT_THAT(FirstError(*drama), StartsWith("drama.lua:2: track: uses 'shut it': "));
  EXPECT_THAT(FirstError(*drama), HasSubstr("it is 'shut'"));
  EXPECT_EQ(State("keeper").position.x, 1.0f);
}

TEST_F(TimelineTest, EaseShapesTheWayOfWhoIsLed) {
  const auto drama = Make(R"(
    track{ actor = "keeper", clips = {
      {at = 0, length = 4, clip = "walk", from = {x = 0}, to = {x = 4}, ease = "smooth"}}})");
  PlayTo(*drama, 1.0);
  EXPECT_NEAR(State("keeper").position.x, 4.0 * Eased(Ease::kSmooth, 0.25), 1e-4);
  PlayTo(*drama, 2.0);
  EXPECT_NEAR(State("keeper").position.x, 2.0, 1e-4);
}

TEST_F(TimelineTest, MistakesAreToldWithTheirItem) {
  const struct {
    const char* track;
    const char* problem;
  } kMistakes[] = {
      {"speech = {{at = 1, line = 'salvete'}, {at = 2, line = 'poem'}}",
       "track: speech[2]: there is no line 'poem'"},
      {"speech = {{line = 'salvete'}}", "track: speech[1]: has no `at`"},
      {"walks = {{at = 1}}", "track: walks[1]: say where to go"},
      {"uses = {{at = 1, object = 'anvil'}}", "track: uses[1]: there is no object 'anvil'"},
      {"uses = {{at = 1, object = 'chest', action = 'eat'}}", "'chest' has no action 'eat'"},
      {"gaze = {{at = 1, target = 'nobody'}}", "there is no actor or object"},
      {"expressions = {{at = 1, expression = 'hunger'}}", "there is no expression 'hunger'"},
      {"expressions = {{at = 1, expression = 'joy', intensity = 3}}", "intensity must be"},
      {"gestures = {{at = 1, clip = 'fly'}}", "has no clip 'fly'"},
      {"gestures = {{at = 1, clip = 'bow', part = 'foot'}}", "the part must be"},
      {"dances = {}", "track: there is no lane 'dances'"},
      {"speech = 3", "must be a list of items"},
      {"speech = {3}", "write an item {at = 0, ...} here"},
      {"clips = {{length = 1, clip = 'idle'}}", "track: clips[1]: at must be a number"},
      {"lights = {{at = 1, light = 'lamp'}, {light = 'lamp'}}",
       "track: lights[2]: at must be a number"},
      {"sounds = {{at = 1, length = 'long'}}", "track: sounds[1]: length must be a number"},
      {"descriptions = {3}", "track: descriptions[1]: write an item {at = 0, ...} here"},
  };
  for (const auto& mistake : kMistakes) {
    const auto drama = Make(std::string("\ntrack{ actor = 'keeper', ") + mistake.track + " }\n");
    EXPECT_THAT(FirstError(*drama), HasSubstr(mistake.problem)) << mistake.track;
    EXPECT_THAT(FirstError(*drama), StartsWith("drama.lua:2: ")) << mistake.track;
  }
}

TEST_F(TimelineTest, LanesOfAnActorNeedOne) {
  for (const std::string lane : {"clips", "gaze", "speech"}) {
    const auto drama = Make("track{ " + lane + " = {{at = 1}} }");
    EXPECT_EQ(FirstError(*drama), "drama.lua:1: track: " + lane + " need an actor");
  }
}

TEST_F(TimelineTest, CaptionsAreShownWithoutAnybodySpeaking) {
  const auto drama = Make(R"(
    track{captions = {
      {at = 1, length = 3, line = "salvete"},
      {at = 6, line = "salvete"},
    }})");
  EXPECT_TRUE(stage_.captions().empty());
  PlayTo(*drama, 2.0);
  ASSERT_EQ(stage_.captions().size(), 1u);
  EXPECT_EQ(stage_.captions()[0].ticks, 120);
  EXPECT_FALSE(State("keeper").utterance.speaking);
  const stage::StageSnapshot then = Snapshot();
  PlayTo(*drama, 4.5);
  EXPECT_TRUE(stage_.captions().empty());
  PlayTo(*drama, 6.5);
  EXPECT_EQ(stage_.captions().size(), 1u);
  PlayTo(*drama, 7.5);
  EXPECT_TRUE(stage_.captions().empty()) << "without a length, as long as it would be said";
  ASSERT_TRUE(drama->Seek(2.0).ok());
  EXPECT_TRUE(Snapshot() == then);
  EXPECT_EQ(FirstError(*drama), "");
}

TEST_F(TimelineTest, ExpressionsComeAndGoAsTheirEaseSays) {
  const auto drama = Make(R"(
    track{actor = "keeper", walks = {{at = 0, from = {x = 0, z = 0}}}, expressions = {
      {at = 1, length = 4, expression = "joy", fade = 2, ease = "in"},
    }}
    track{actor = "guest", walks = {{at = 0, from = {x = 1, z = 0}}}, expressions = {
      {at = 1, length = 4, expression = "joy", fade = 2},
    }})");
  const auto joy = [&](const char* name) {
    return State(name)
        .animation_state.face.expressions[static_cast<size_t>(human::Expression::kJoy)];
  };
  PlayTo(*drama, 2.0);
  EXPECT_NEAR(joy("keeper"), 0.25f, 0.01f);
  EXPECT_NEAR(joy("guest"), 0.5f, 0.01f);
  PlayTo(*drama, 3.1);
  EXPECT_NEAR(joy("keeper"), 1.0f, 1e-6f);
  PlayTo(*drama, 6.0);
  EXPECT_NEAR(joy("keeper"), 0.75f, 0.01f);
  PlayTo(*drama, 7.1);
  EXPECT_NEAR(joy("keeper"), 0.0f, 1e-6f);
}

TEST_F(TimelineTest, AnEaseThatNobodyKnowsIsToldWithItsItem) {
  const auto drama = Make(R"(
    track{actor = "keeper", expressions = {{at = 1, expression = "joy", ease = "bouncy"}}})");
  EXPECT_THAT(FirstError(*drama), HasSubstr("expressions[1]: ease is linear, in, out or smooth"));
}

}  // namespace
}  // namespace lararium::drama
