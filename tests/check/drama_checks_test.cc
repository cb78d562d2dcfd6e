// Each check reports its problem with the location, and reports nothing if there is none.

#include "editor/check/drama_checks.h"

#include <gmock/gmock.h>

#include "editor/text/text.h"
#include "tests/drama/drama_fixture.h"
#include "tests/stage/test_props.h"

namespace lararium::editor {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class DramaChecksTest : public drama::DramaTest {
 protected:
  DramaChecksTest() {
    EXPECT_TRUE(stage_.AddObject("cup", test::Model(test::MakeCup()), {{0.0f, 0.0f, -2.0f}}).ok());
    EXPECT_TRUE(
        stage_.AddObject("chest", test::Model(test::MakeChest()), {{1.5f, 0.0f, 0.0f}}).ok());
    human::VisemeTrack track;
    track.duration = 1.0f;
    EXPECT_TRUE(stage_.AddSpeech("salvete", track).ok());
  }

  // Runs a script for `seconds`.
  void Run(const std::string& script, double seconds = 20.0) {
    script_ = script;
    drama_ = Make(script);
    const auto places = Places();
    steps_ = std::make_unique<StepListener>(stage_, places);
    steps_->Listen(0.0);
    while (drama_->time() < seconds) {
      drama_->Tick();
      steps_->Listen(drama_->time());
    }
    tasks_.assign(drama_->tasks().begin(), drama_->tasks().end());
    PlaceItems(script_, "drama.lua", tasks_);
  }
  std::vector<std::string> Together() const { return EnglishOf(CheckTogether(tasks_)); }
  std::vector<std::string> Turns() const { return EnglishOf(CheckTurns(tasks_)); }
  std::vector<std::string> Cues(bool visited) {
    CuesSeen seen;
    seen.cues.assign(drama_->cues().begin(), drama_->cues().end());
    seen.lines = lines_;
    seen.visited = visited;
    seen.seconds = 20.0;
    return EnglishOf(CheckCues(script_, "drama.lua", seen));
  }
  std::vector<std::string> Steps() {
    return EnglishOf(steps_->Problems(script_, "drama.lua", tasks_));
  }

  // A wall across the stage, at z from -1 to -1.2.
  std::vector<stage::Place> Places() const {
    stage::Occluder wall;
    wall.name = "wall";
    wall.blocks_walking = wall_blocks_walking_;
    const stage::PropMesh box = test::MakeBox({-3.0f, 0.0f, -1.2f}, {3.0f, 2.0f, -1.0f});
    wall.mesh.positions = box.positions;
    wall.mesh.indices = box.indices;
    std::vector<stage::Place> places(1);
    places[0].occluders.push_back(std::move(wall));
    return places;
  }

  bool wall_blocks_walking_ = true;
  std::string script_;
  std::unique_ptr<drama::Drama> drama_;
  std::unique_ptr<StepListener> steps_;
  std::vector<drama::TaskRecord> tasks_;
  std::set<std::string, std::less<>> lines_;
};

TEST_F(DramaChecksTest, ADramaThatIsInOrderHasNoProblems) {
  Run(R"(
    local keeper, guest = actor("keeper"), actor("guest")
    track{actor = "keeper",
      walks = {
        {at = 0, from = {x = -2, z = 1}},
        {at = 1, to = {x = -1, z = 1}},
      },
      uses = {{at = 5, object = "chest", action = "open"}},
    }
    track{markers = {{at = 12, name = "noon"}}}
    function main()
      guest:place{x = 2, z = 2}
      on(visitor:near(keeper), function() end)
      first(marker("noon"), timeout(15))
      guest:walk_to{x = 1, z = 2}
      guest:say("salvete")
    end)");
  lines_ = {"salvete"};
  EXPECT_EQ(drama::FirstError(*drama_), "");
  EXPECT_THAT(Together(), IsEmpty());
  EXPECT_THAT(Turns(), IsEmpty());
  EXPECT_THAT(Steps(), IsEmpty());
  // timeout(15) does not fire, because the marker comes before it.
  EXPECT_THAT(Cues(false), ElementsAre(HasSubstr("no run reaches the trigger 'timeout'")));
}

TEST_F(DramaChecksTest, NobodyIsInTwoPlacesAtOnce) {
  Run(R"(
    track{actor = "keeper",
      walks = {
        {at = 0, from = {x = -2, z = 1}},
        {at = 1, to = {x = 3, z = 3}},
      },
      uses = {
        {at = 2, object = "chest", action = "open"},
      },
    })");
  const auto problems = Together();
  ASSERT_EQ(problems.size(), 1u);
  LoadTexts(LARARIUM_LOCALE_DIR, "it");
  const std::string italian = CheckTogether(tasks_)[0].Translated(Tr);
  LoadTexts(LARARIUM_LOCALE_DIR, "en");
  EXPECT_THAT(italian, StartsWith("drama.lua:8: keeper dovrebbe essere in due posti insieme: "
                                  "'use open chest' comincia a 2.00 s, 'walk_to' (drama.lua:5)"));
  EXPECT_THAT(problems[0], AllOf(StartsWith("drama.lua:8: keeper must be in two places at once"),
                                 HasSubstr("'walk_to' (drama.lua:5)")));
}

TEST_F(DramaChecksTest, WhatMayFailMayOverlap) {
  Run(R"(
    local keeper = actor("keeper")
    function main()
      keeper:place{x = -2, z = 1}
      start(function() keeper:walk_to{x = 3, z = 3} end)
      wait(0.5)
      attempt(keeper.turn_to, keeper, 90)
    end)");
  EXPECT_THAT(Together(), IsEmpty());
}

TEST_F(DramaChecksTest, WhoWaitsForAThingIsToldWhoHasIt) {
  Run(R"(
    local keeper, guest = actor("keeper"), actor("guest")
    function main()
      keeper:place{x = 1.5, z = 1, heading = 0}
      guest:place{x = 2.5, z = 1, heading = 0}
      start(function() keeper:use("chest", "open", {seconds = 6}) end)
      wait(0.5)
      guest:use("chest", "shut")
    end)");
  EXPECT_THAT(Turns(),
              ElementsAre(AllOf(StartsWith("drama.lua:8: guest waits"),
                                HasSubstr("for 'chest', which keeper has: 'use open chest'"),
                                HasSubstr("drama.lua:6"))));
}

TEST_F(DramaChecksTest, TakingWhatAnotherHoldsFails) {
  Run(R"(
    local keeper, guest = actor("keeper"), actor("guest")
    function main()
      keeper:place{x = 0, z = -2.4, heading = 0}
      guest:place{x = 1, z = -3, heading = 0}
      keeper:take("cup")
      guest:take("cup")
    end)");
  EXPECT_THAT(drama::FirstError(*drama_), HasSubstr("drama.lua:7: take"));
}

TEST_F(DramaChecksTest, WaysThroughWallsAreTold) {
  Run(R"(
    track{actor = "guest", clips = {
      {at = 0, length = 1, clip = "idle", from = {x = 0, z = 1}},
      {at = 1, length = 4, clip = "walk", to = {x = 0, z = -3}},
    }})");
  EXPECT_THAT(Steps(), Contains(StartsWith("drama.lua:4: guest walks through 'wall' (at ")));
}

TEST_F(DramaChecksTest, WhatDoesNotBlockWalkingIsNotInTheWay) {
  wall_blocks_walking_ = false;
  Run(R"(
    track{actor = "guest", clips = {
      {at = 0, length = 1, clip = "idle", from = {x = 0, z = 1}},
      {at = 1, length = 4, clip = "walk", to = {x = 0, z = -3}},
    }})");
  EXPECT_THAT(Steps(), Not(Contains(HasSubstr("'wall'"))));
}

TEST_F(DramaChecksTest, StandingInAWallAndLeapsAreTold) {
  Run(R"(
    function main()
      actor("guest"):place{x = 0, z = -1.1}
      wait(1)
      actor("guest"):place{x = 0, z = 3}
    end)");
  EXPECT_THAT(Steps(), ElementsAre(StartsWith("drama.lua:3: guest stands in 'wall'"),
                                   StartsWith("drama.lua:5: guest jumps while visible")));
}

TEST_F(DramaChecksTest, WhoIsHiddenMayAppearElsewhere) {
  Run(R"(
    function main()
      actor("guest"):place{x = 0, z = 1}
      wait(1)
      actor("guest"):hide()
      wait(1)
      actor("guest"):place{x = 0, z = -3}
    end)");
  EXPECT_THAT(Steps(), IsEmpty());
}

TEST_F(DramaChecksTest, MarkersAndTheirListenersHaveToMeet) {
  Run(R"(
    track{markers = {
      {at = 1, name = "alone"},
      {at = 2, name = "noon"},
    }}
    on(marker("noon"), function() end)
    on(marker("nowhere"), function() end))");
  EXPECT_THAT(Cues(false), ElementsAre("drama.lua:3: nothing begins at the marker 'alone'",
                                       "drama.lua:7: no track has a marker 'nowhere'"));
}

TEST_F(DramaChecksTest, CuesThatNoRunReachesAreTold) {
  const char* script = R"(
    local keeper = actor("keeper")
    local function never()
      on(visitor:leaves(keeper), function() end)
      keeper:say("salvete")
    end
    function main()
      keeper:place{x = 0, z = 2}
      if first(visitor:near(keeper, 1), timeout(2)) == 1 then
        never()
      end
    end)";
  Run(script);
  EXPECT_THAT(Cues(true),
              ElementsAre(HasSubstr("drama.lua:9: no run reaches the trigger 'near' (in 20 s)"),
                          HasSubstr("drama.lua:4: no run reaches this 'on'"),
                          HasSubstr("drama.lua:5: no run says the line 'salvete'")));
  // Without a visitor it is unknown what one would do.
  EXPECT_THAT(Cues(false), ElementsAre(HasSubstr("'on'"), HasSubstr("'salvete'")));
  // Another run reaches it.
  CuesSeen both;
  both.cues = {{"drama.lua:9", "near", "", true},
               {"drama.lua:9", "timeout", "", true},
               {"drama.lua:4", "leaves", "", true}};
  both.lines = {"salvete"};
  both.visited = true;
  EXPECT_THAT(CheckCues(script, "drama.lua", both), IsEmpty());
}

// The problems of a person above a floor that is `floor_height` high.
std::vector<std::string> GroundProblems(const stage::Stage& stage,
                                        drama::Drama& drama,
                                        float floor_height,
                                        bool receives_shadow,
                                        float half_width = 3.0f) {
  std::vector<stage::Place> places(2);
  places[0].name = "bar";
  places[1].name = "yard";
  stage::Occluder floor;
  floor.name = "floor";
  floor.receives_shadow = receives_shadow;
  const float x = half_width;
  floor.mesh = {.positions = {{-x, floor_height, -3.0f},
                              {x, floor_height, -3.0f},
                              {x, floor_height, 3.0f},
                              {-x, floor_height, 3.0f}},
                .normals = {},
                .indices = {0, 2, 1, 0, 3, 2}};
  places[0].occluders = {floor};
  GroundListener ground(stage, places);
  for (ground.Listen(0.0); drama.time() < 5.0;) {
    drama.Tick();
    ground.Listen(drama.time());
  }
  return EnglishOf(ground.Problems());
}

TEST(CheckOccluders, FindsThoseInOtherUnitsOrCoordinates) {
  std::vector<stage::Place> places(1);
  places[0].name = "bar";
  stage::Occluder& wall = places[0].occluders.emplace_back();
  wall.name = "wall";
  wall.mesh = {
      .positions = {{-2, 0, -3}, {2, 0, -3}, {2, 3, -3}}, .normals = {}, .indices = {0, 1, 2}};
  EXPECT_THAT(EnglishOf(CheckOccluders(places)), IsEmpty());
  wall.stage_from_mesh.translation.x() = 4'500'000.0;
  EXPECT_THAT(EnglishOf(CheckOccluders(places)),
              ElementsAre(HasSubstr("occluder 'wall' lies 4499998 m from the stage")));
  wall.stage_from_mesh.translation.x() = 0.0;
  for (const double scale : {0.001, 10'000.0}) {
    wall.stage_from_mesh.scale = scale;
    EXPECT_THAT(EnglishOf(CheckOccluders(places)), ElementsAre(HasSubstr("unit"))) << scale;
  }
}

TEST_F(DramaChecksTest, PeopleWithoutAnythingThatCatchesTheirShadowsSeemToFloat) {
  const char* const script = R"(actor("keeper"):place{x = 1, z = 1})";
  const auto problems = [&](float height, bool receives_shadow, float half_width = 3.0f) {
    return GroundProblems(stage_, *(drama_ = Make(script)), height, receives_shadow, half_width);
  };
  EXPECT_THAT(problems(0.0f, true), ElementsAre(StartsWith("yard: people seem to float")))
      << "which has no occluders at all";
  EXPECT_THAT(problems(-0.2f, true).size(), 1u);
  EXPECT_THAT(
      problems(0.0f, false),
      ElementsAre(AllOf(StartsWith("bar: "), HasSubstr("below keeper")), StartsWith("yard")));
  EXPECT_THAT(problems(-0.5f, true).size(), 2u) << "too deep";
  EXPECT_THAT(problems(0.0f, true, 0.5f).size(), 2u) << "elsewhere";
}

}  // namespace
}  // namespace lararium::editor
