#include "shared/show/show.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "shared/core/random.h"
#include "tests/audio/test_sounds.h"
#include "tests/show/small_show.h"
#include "tests/stage/test_human.h"
#include "tests/stage/test_props.h"

namespace lararium::show {
namespace {

class ShowTest : public ::testing::Test {
 protected:
  std::unique_ptr<Show> Make() { return Show::Create(test::SmallContent(), {}, *log_).value(); }
  StagedFrame At(Show& show, double time) {
    StagedFrame staged;
    show.StageFrame(test::FakePoses().Track({}), time, staged);
    return staged;
  }

  std::shared_ptr<Log> log_ = MakeSilentLog();
};

float PositionX(const StagedFrame& staged) {
  return staged.people.actors.at(0).stage_from_actor[3].x;
}

TEST_F(ShowTest, DrawsBetweenTwoTicks) {
  const std::unique_ptr<Show> show = Make();
  for (const double time : {0.0, 0.1, 0.1 + 0.4 / 120.0, 0.1 + 0.9 / 120.0, 0.5}) {
    EXPECT_NEAR(PositionX(At(*show, time)), time, 1e-4) << time;
  }
}

TEST_F(ShowTest, PosesTheClipAtTheSameMoment) {
  const std::unique_ptr<Show> show = Make();
  const StagedFrame staged = At(*show, 0.25);
  ASSERT_EQ(staged.people.actors.at(0).skin_count, 1u);
  EXPECT_NEAR(staged.people.skin.at(0)[3].y, 0.25f, 1e-4f);
}

TEST_F(ShowTest, AnyOrderOfTimesGivesTheStateOfPlaying) {
  const std::unique_ptr<Show> played = Make();
  std::vector<float> expected;
  for (int i = 0; i <= 60; ++i) {
    expected.push_back(PositionX(At(*played, i / 60.0)));
  }
  const std::unique_ptr<Show> sought = Make();
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const auto i = random.Below(61);
    EXPECT_EQ(PositionX(At(*sought, i / 60.0)), expected[i]);
  }
}

TEST_F(ShowTest, AnotherMomentIsStagedAsItWillBeAndLeavesNoTrace) {
  // The actor's position shows whether the visitor was present a moment ago.
  ShowContent content = test::SmallContent();
  content.drama = R"(
    local one = actor("one")
    function main()
      one:place{x = 0, z = 0}
      while true do
        wait(0.25)
        if visitor:is_here() then one:place{x = 7, z = 0} end
        if not visitor:is_here() then one:place{x = -7, z = 0} end
      end
    end
  )";
  drama::DramaOptions options;
  options.past = drama::Past::kRepeated;
  const auto plain = Show::Create(content, options, *log_).value();
  const auto glancing = Show::Create(content, options, *log_).value();
  StagedFrame expected, staged, other;
  for (int i = 0; i <= 120; ++i) {
    vision::TrackedFrame tracked = test::FakePoses().Track({});
    if (i >= 80) {
      tracked.camera_from_map.reset();  // The visitor looks away.
    }
    const double time = i <= 40 ? i / 30.0 : (i - 20) / 30.0;  // Goes back once.
    plain->StageFrame(tracked, time, expected);
    glancing->StageFrame(tracked, time, staged);
    ASSERT_EQ(staged.people.actors.at(0).stage_from_actor,
              expected.people.actors.at(0).stage_from_actor)
        << i;
    ASSERT_EQ(staged.people.skin, expected.people.skin) << i;
    for (const double offset : {-0.5, -0.25, 0.25, 0.5, 1.5}) {
      ASSERT_TRUE(glancing->StageAtTime(time + offset, staged, other).ok());
    }
  }
  EXPECT_NEAR(PositionX(expected), -7.0f, 0.1f) << "the drama does not depend on the visitor";
  EXPECT_TRUE(plain->drama().errors().empty()) << plain->drama().errors().front().message;
  EXPECT_TRUE(glancing->drama().errors().empty());
}

TEST_F(ShowTest, AnotherMomentIsThatOfTheDrama) {
  const std::unique_ptr<Show> show = Make();
  const StagedFrame staged = At(*show, 0.5);
  StagedFrame other;
  for (const double time : {0.0, 0.25, 0.75, 0.9}) {
    ASSERT_TRUE(show->StageAtTime(time, staged, other).ok());
    EXPECT_NEAR(PositionX(other), time, 1e-4);
    EXPECT_NEAR(other.time, time, 1e-9);
    EXPECT_EQ(other.camera.camera_from_stage->translation,
              staged.camera.camera_from_stage->translation);
    EXPECT_EQ(PositionX(At(*show, 0.5)), PositionX(staged));
  }
}

TEST_F(ShowTest, ThePoseOnTheStageIsMetric) {
  const std::unique_ptr<Show> show = Make();
  const StagedFrame staged = At(*show, 0.0);
  // The map's scale is twice the stage's, so 4 map units are 2 metres.
  ASSERT_TRUE(staged.camera.camera_from_stage.has_value());
  EXPECT_NEAR(staged.camera.camera_from_stage->translation.z(), 2.0, 1e-12);
}

TEST_F(ShowTest, TheStageGoesWhereTheFramesMapSaysAndTheDramaRunsOn) {
  const std::unique_ptr<Show> show = Make();
  StagedFrame staged;
  const auto stage = [&](double time, std::optional<uint32_t> map) {
    vision::TrackedFrame tracked;
    if (map) {
      tracked = test::FakePoses().Track({});
      tracked.map = *map;
    }
    show->StageFrame(tracked, time, staged);
    EXPECT_NEAR(PositionX(staged), time, 1e-4);
  };
  struct Step {
    std::optional<uint32_t> map;
    uint32_t place;
    double depth;  // 4 map units, in metres of the place.
  };
  // The scale of the bar's map is twice the stage's, the yard's is half of it.
  double time = 0.0;
  for (const Step& step : {Step{0, 0, 2.0}, Step{1, 1, 8.0}, Step{std::nullopt, 1, 0.0},
                           Step{std::nullopt, 1, 0.0}, Step{1, 1, 8.0}, Step{0, 0, 2.0}}) {
    stage(time, step.map);
    EXPECT_EQ(staged.camera.place, step.place) << time;
    ASSERT_EQ(staged.camera.camera_from_stage.has_value(), step.map.has_value()) << time;
    if (step.map) {
      EXPECT_NEAR(staged.camera.camera_from_stage->translation.z(), step.depth, 1e-12) << time;
    }
    time += 0.1;
  }
}

TEST_F(ShowTest, StagingOnePlaceAnewLeavesTheOthers) {
  const std::unique_ptr<Show> show = Make();
  stage::Place moved = show->content().places[1].stage;
  moved.camera_nudge = {0.0, 0.0, 1.0};
  show->SetPlace(1, moved);
  StagedFrame staged;
  vision::TrackedFrame tracked = test::FakePoses().Track({});
  show->StageFrame(tracked, 0.0, staged);
  EXPECT_NEAR(staged.camera.camera_from_stage->translation.z(), 2.0, 1e-12);
  tracked.map = 1;
  show->StageFrame(tracked, 0.1, staged);
  EXPECT_NEAR(staged.camera.camera_from_stage->translation.z(), 7.0, 1e-12);
}

TEST_F(ShowTest, AWallThatWasMovedIsGoneRoundAsIfItHadAlwaysStoodThere) {
  const auto with_wall = [](float x, bool blocks = true) {
    ShowContent content = test::SmallContent();
    content.cast[0].human = test::MakeTestHuman();
    content.drama = R"(
      function main()
        actor("one"):place{x = 0, z = 0}
        actor("one"):walk_to{x = 0, z = -4}
      end
    )";
    stage::Occluder& wall = content.places[1].stage.occluders.emplace_back();
    const stage::PropMesh box = test::MakeBox({-1.0f, 0.0f, -0.2f}, {1.0f, 2.0f, 0.2f});
    wall.mesh.positions = box.positions;
    wall.mesh.indices = box.indices;
    wall.stage_from_mesh.translation = {x, 0.0, -2.0};
    wall.blocks_walking = blocks;
    return content;
  };
  const auto create = [&](ShowContent content) {
    return Show::Create(std::move(content), {}, *log_).value();
  };
  const std::unique_ptr<Show> show = create(with_wall(3.0f));
  constexpr double kBeside = 2.5;  // seconds: about half of the way
  EXPECT_NEAR(PositionX(At(*show, kBeside)), 0.0f, 0.01f) << "straight on";
  const auto move = [&](float x, bool blocks = true) {
    show->SetPlace(1, with_wall(x, blocks).places[1].stage);
  };
  move(0.7f);
  EXPECT_NEAR(PositionX(At(*show, kBeside)), 0.0f, 0.01f) << "the floor is not laid yet";
  ASSERT_TRUE(show->LayFloor().ok());
  const std::unique_ptr<Show> always = create(with_wall(0.7f));
  for (const double time : {kBeside, kBeside + 0.1, 1.0, 4.0}) {
    const StagedFrame expected = At(*always, time);
    EXPECT_EQ(At(*show, time).people.actors[0].stage_from_actor,
              expected.people.actors[0].stage_from_actor)
        << time;
  }
  EXPECT_LT(PositionX(At(*show, kBeside)), -0.3f) << "round it";

  const int64_t played = show->drama().played_ticks();
  ASSERT_TRUE(show->LayFloor().ok());
  EXPECT_EQ(show->drama().played_ticks(), played) << "nothing was moved";
  move(0.7f, false);
  ASSERT_TRUE(show->LayFloor().ok());
  EXPECT_NEAR(PositionX(At(*show, kBeside)), 0.0f, 0.01f) << "through it";
}

TEST_F(ShowTest, AThingThatWasMovedIsSeenThereAtOnceAndWasAlwaysThereOnceThatIsSettled) {
  const auto with_table = [](float z) {
    ShowContent content = test::SmallContent();
    content.cast[0].human = test::MakeTestHuman();
    content.objects = {{"table", test::Model(test::MakeTable()), {{0.0f, 0.0f, z}}},
                       {"cup", test::Model(test::MakeCup()), {{3.0f, 0.0f, 3.0f}}}};
    content.drama = R"(
      function main()
        object("cup"):place{on = object("table")}
        actor("one"):place{x = 0, z = 0}
        actor("one"):walk_to{x = 0, z = -4}
      end
    )";
    return content;
  };
  const auto create = [&](float z) { return Show::Create(with_table(z), {}, *log_).value(); };
  const auto place_of = [](const StagedFrame& staged, size_t object) {
    return glm::vec3(staged.things.stage_from_part[staged.things.objects.at(object).part_begin][3]);
  };
  constexpr double kBeside = 2.5;  // seconds: about half of the way
  const std::unique_ptr<Show> show = create(2.0f);
  const StagedFrame before = At(*show, kBeside);
  ASSERT_TRUE(show->drama().errors().empty()) << show->drama().errors().front().message;
  EXPECT_NEAR(PositionX(before), 0.0f, 0.01f) << "straight on";

  show->PlaceObject(0, {{0.0f, 0.0f, -2.0f}});
  const StagedFrame moved = At(*show, kBeside);
  const glm::vec3 by(0.0f, 0.0f, -4.0f);
  for (const size_t object : {0, 1}) {
    EXPECT_LT(glm::distance(place_of(moved, object), place_of(before, object) + by), 1e-4f)
        << "what stands on it comes along";
  }
  EXPECT_NEAR(PositionX(moved), 0.0f, 0.01f) << "they go on as before";

  ASSERT_TRUE(show->LayFloor().ok());
  const std::unique_ptr<Show> always = create(-2.0f);
  for (const double time : {kBeside, 1.0, 4.0}) {
    const StagedFrame expected = At(*always, time);
    const StagedFrame settled = At(*show, time);
    EXPECT_EQ(settled.people.actors[0].stage_from_actor, expected.people.actors[0].stage_from_actor)
        << time;
    EXPECT_EQ(settled.things.stage_from_part, expected.things.stage_from_part) << time;
  }
  EXPECT_GT(std::abs(PositionX(At(*show, kBeside))), 0.2f) << "round it";
  const int64_t played = show->drama().played_ticks();
  show->PlaceObject(0, {{0.0f, 0.0f, -2.0f}});
  ASSERT_TRUE(show->LayFloor().ok());
  EXPECT_EQ(show->drama().played_ticks(), played) << "nothing was moved";
}

TEST_F(ShowTest, WhereAThingIsSinceSomebodyMovedItStaysUntilThatIsSettled) {
  ShowContent content = test::SmallContent();
  content.objects = {{"lamp", test::Model(test::MakeLamp()), {{1.0f, 0.0f, -2.0f}}}};
  content.drama += "function main() wait(1); object('lamp'):place{x = 5, z = 0} end";
  const std::unique_ptr<Show> show = Show::Create(std::move(content), {}, *log_).value();
  const auto x_at = [&](double time) {
    const StagedFrame staged = At(*show, time);
    return staged.things.stage_from_part[staged.things.objects.at(0).part_begin][3].x;
  };
  EXPECT_NEAR(x_at(1.5), 5.0f, 1e-5f);
  show->PlaceObject(0, {{2.0f, 0.0f, -2.0f}});
  EXPECT_NEAR(x_at(1.5), 5.0f, 1e-5f);
  ASSERT_TRUE(show->LayFloor().ok());
  EXPECT_NEAR(x_at(1.5), 5.0f, 1e-5f);
  EXPECT_NEAR(x_at(0.5), 2.0f, 1e-5f);
}

TEST_F(ShowTest, TheGainIsSteadiedUntilThePlaceChangesOrThePoseIsLost) {
  const std::unique_ptr<Show> show = Make();
  StagedFrame staged;
  double time = 0.0;
  const auto gain_of = [&](float gain, uint32_t map) {
    vision::TrackedFrame tracked = test::FakePoses().Track({});
    tracked.frame.capture_time = time += 1.0 / 30.0;
    tracked.map = map;
    tracked.gain = {gain, gain, gain};
    show->StageFrame(tracked, time, staged);
    return staged.camera.gain[0];
  };
  EXPECT_FLOAT_EQ(gain_of(1.0f, 0), 1.0f);
  const float steadied = gain_of(0.8f, 0);
  EXPECT_GT(steadied, 0.81f);
  EXPECT_LT(steadied, 0.95f);
  EXPECT_FLOAT_EQ(gain_of(2.0f, 1), 2.0f);
  show->StageFrame({}, time, staged);
  EXPECT_FLOAT_EQ(gain_of(0.25f, 1), 0.25f);
}

TEST_F(ShowTest, WithoutAPoseNothingIsPlaced) {
  const std::unique_ptr<Show> show = Make();
  StagedFrame staged = At(*show, 0.0);
  show->StageFrame({}, 0.1, staged);
  EXPECT_FALSE(staged.camera.camera_from_stage.has_value());
}

TEST_F(ShowTest, SteadyPlayReusesItsBuffers) {
  const std::unique_ptr<Show> show = Make();
  StagedFrame staged = At(*show, 0.0);
  const glm::mat4* skin = staged.people.skin.data();
  for (int i = 1; i < 100; ++i) {
    show->StageFrame({}, i / 100.0, staged);
    EXPECT_EQ(staged.people.skin.data(), skin);
  }
}

TEST_F(ShowTest, ADramaHoldsWhileTrackingIsLostIfItsAuthorWantsThat) {
  show::ShowContent content = test::SmallContent();
  content.drama = "drama{when_lost = 'hold', patience = 0.5}\n" + content.drama;
  const std::unique_ptr<Show> show = Show::Create(std::move(content), {}, *log_).value();
  StagedFrame staged;
  double time = 0.0;
  const auto play = [&](bool tracked, double seconds) {
    for (int i = 0; i < seconds * 60.0; ++i) {
      time += 1.0 / 60.0;
      show->StageFrame(tracked ? test::FakePoses().Track({}) : vision::TrackedFrame(), time,
                       staged);
    }
  };
  play(true, 0.2);
  EXPECT_NEAR(staged.time, 0.2, 1e-6);
  play(false, 2.0);
  EXPECT_NEAR(staged.time, 0.7, 0.04) << "has patience for half a second";
  play(true, 0.2);
  EXPECT_NEAR(staged.time, 0.9, 0.04) << "goes on where it was";
  time = -1.0 / 60.0;
  play(true, 0.1);
  EXPECT_NEAR(staged.time, 0.1, 0.02) << "who goes back has nothing to catch up with";
}

TEST_F(ShowTest, AHeldDramaGoesOnWhereItWas) {
  const std::unique_ptr<Show> show = Make();
  StagedFrame staged = At(*show, 0.5);
  show->input().Hold(true);
  for (const double time : {0.6, 1.0, 2.0}) {
    show->StageFrame({}, time, staged);
    EXPECT_NEAR(staged.time, 0.5, 1e-6) << time;
  }
  show->input().RestartAt(3.0);
  show->StageFrame({}, 2.5, staged);
  EXPECT_NEAR(staged.time, 3.0, 1e-6) << "goes to another moment, and stays there";
  show->StageFrame({}, 2.8, staged);
  EXPECT_NEAR(staged.time, 3.0, 1e-6);
  show->input().Hold(false);
  show->StageFrame({}, 2.9, staged);
  EXPECT_NEAR(staged.time, 3.1, 1e-6);
}

TEST_F(ShowTest, TheDramaHearsOfItsVisitor) {
  show::ShowContent content = test::SmallContent();
  content.drama = R"(
    local one = actor("one")
    on(key("space"), function() one:place{ x = 1 } end)
    on(clock("9:30"), function() one:place{ z = 1 } end)
    function main()
      one:place{x = 0, z = 0}
      one:place{}
      wait(0.2)
      one:place{ y = visitor:where().z }
    end)";
  const std::unique_ptr<Show> show = Show::Create(std::move(content), {}, *log_).value();
  show->input().SetHour(9.4f);
  StagedFrame staged = At(*show, 0.1);
  show->input().PressKey("space");
  show->input().SetHour(9.6f);
  staged = At(*show, 0.3);
  const glm::vec3 at = staged.people.actors.at(0).stage_from_actor[3];
  EXPECT_EQ(at.x, 1.0f);
  EXPECT_EQ(at.z, 1.0f);
  // The camera is 4 map units from the stage's origin, at 2 units per metre.
  EXPECT_NEAR(at.y, -2.0f, 1e-3f);
}

TEST_F(ShowTest, AScriptThatDoesNotCompileIsNamed) {
  ShowContent content = test::SmallContent();
  content.drama = "local = 3";
  const Result<std::unique_ptr<Show>> show = Show::Create(std::move(content), {}, *log_);
  ASSERT_FALSE(show.ok());
  EXPECT_NE(show.message().find("drama.lua:1"), std::string::npos) << show.message();
}

TEST_F(ShowTest, AnEndlessLoopDoesNotStopTheShow) {
  ShowContent content = test::SmallContent();
  content.drama += "\nfunction main() while true do end end";
  const std::unique_ptr<Show> show = Show::Create(std::move(content), {}, *log_).value();
  EXPECT_NEAR(PositionX(At(*show, 0.5)), 0.5, 1e-4);
  EXPECT_FALSE(show->drama().errors().empty());
}

TEST_F(ShowTest, LampsBurnWhereTheirObjectsAreAndAsTheDramaSays) {
  ShowContent content = test::SmallContent();
  content.objects = {{"lamp", test::Model(test::MakeLamp()), {{1.0f, 0.0f, -2.0f}}}};
  content.drama += "function main() wait(1); light('lamp'):set{ level = 0 } end";
  const std::unique_ptr<Show> show = Show::Create(std::move(content), {}, *log_).value();
  const StagedFrame lit = At(*show, 0.5);
  ASSERT_EQ(lit.things.lamps.size(), 1u);
  EXPECT_LT(glm::distance(lit.things.lamps[0].position, glm::vec3(1.0f, 0.1f, -2.0f)), 1e-5f);
  EXPECT_GT(lit.things.objects.at(0).glow, 0.5f);
  EXPECT_EQ(At(*show, 0.5).things.lamps[0].intensity,
            lit.things.lamps[0].intensity);  // Depends on time only.
  const StagedFrame out = At(*show, 1.5);
  EXPECT_TRUE(out.things.lamps.empty());
  EXPECT_EQ(out.things.objects.at(0).glow, 0.0f);
}

TEST_F(ShowTest, ActorsAreInTheLightOfWhereTheyStandAndOfTheDramasHour) {
  ShowContent content = test::SmallContent();
  content.drama += "function main() daylight:set_time(9); wait(0.75); daylight:set_time(15) end";
  std::vector<light::PlacedProbe>& probes = content.places[0].stage.probes;
  probes.clear();
  for (const auto& [x, hour, radiance] :
       {std::tuple(0.0f, 9.0, 1.0f), {0.0f, 15.0, 2.0f}, {1.0f, 9.0, 3.0f}, {1.0f, 15.0, 6.0f}}) {
    light::ProbeLight light;
    light.sky[0] = glm::vec3(radiance);
    probes.push_back({{x, 0.8f, 0.0f}, hour, light});  // Half as high as the person.
  }
  const std::unique_ptr<Show> show = Show::Create(std::move(content), {}, *log_).value();
  const auto radiance_at = [&](double time) {
    return At(*show, time).people.actors.at(0).light.sky[0].r;
  };
  EXPECT_NEAR(radiance_at(0.0), 1.0f, 1e-3f);
  EXPECT_NEAR(radiance_at(0.5), 2.0f, 1e-3f);  // The middle, at nine o'clock.
  EXPECT_NEAR(radiance_at(1.0), 6.0f, 1e-3f);
  float before = radiance_at(0.0);
  for (double time = 0.0; time < 0.74; time += 1.0 / 60.0) {
    const float now = radiance_at(time);
    EXPECT_LT(std::abs(now - before), 0.12f) << time;
    before = now;
  }
}

TEST_F(ShowTest, WhileTrackingIsLostPeopleAreHeldThenFadeThenTheVisitorIsGuided) {
  const std::unique_ptr<Show> show = Make();
  show->SetTrackingLossFader({});
  StagedFrame staged;
  const auto stage = [&](double time, bool tracked) {
    vision::TrackedFrame frame = test::FakePoses().Track({});
    frame.camera = geometry::CameraModel{64, 48, 50.0, 50.0, 31.5, 23.5};
    frame.frame.capture_time = time;
    if (!tracked) {
      frame.camera_from_map.reset();
    }
    show->StageFrame(frame, time, staged);
  };
  double time = 0.0;
  for (; time < 1.0; time += 1.0 / 30.0) {
    stage(time, true);
  }
  const auto seen = staged.camera.camera_from_stage;
  EXPECT_EQ(staged.camera.opacity, 1.0f);
  stage(time, false);
  EXPECT_EQ(staged.camera.opacity, 1.0f);
  EXPECT_EQ(staged.camera.state, TrackingLossFader::State::kHeld);
  ASSERT_TRUE(staged.camera.camera_from_stage);
  EXPECT_NEAR((staged.camera.camera_from_stage->Center() - seen->Center()).norm(), 0.0, 1e-6);
  EXPECT_EQ(staged.camera.gain, (std::array<float, 3>{1.0f, 1.0f, 1.0f}));
  for (const double end = time + 3.5; time < end; time += 1.0 / 30.0) {
    stage(time, false);
  }
  EXPECT_EQ(staged.camera.opacity, 0.0f);
  EXPECT_FALSE(staged.camera.camera_from_stage);
  EXPECT_EQ(staged.camera.guide.opacity, 1.0f);
  EXPECT_FALSE(staged.people.actors.empty()) << "the drama runs on";
  stage(time, true);
  EXPECT_LT(staged.camera.opacity, 0.2f);
  EXPECT_TRUE(staged.camera.camera_from_stage);
}

TEST_F(ShowTest, WhatIsDescribedIsHeardAndReadByWhoeverChoseIt) {
  ShowContent content = test::SmallContent();
  human::VisemeTrack track;
  track.duration = 2.0f;
  content.speech = {{.name = "d_bar",
                     .visemes = track,
                     .sound = test::Encode(test::Noise(2.0), 1),
                     .captions = {{0.0, 2.0, "A bar."}},
                     .describes = true}};
  content.drama = "track{descriptions = {{at = 1, line = \"d_bar\"}}}";
  const std::unique_ptr<Show> show = Show::Create(std::move(content), {}, *log_).value();
  const StagedFrame without = At(*show, 1.5);
  EXPECT_TRUE(without.lines.empty());
  EXPECT_TRUE(without.sound.voices.empty());
  show->input().SetDescriptions(true);
  const StagedFrame with = At(*show, 1.5);
  ASSERT_EQ(with.lines.size(), 1u);
  EXPECT_EQ(with.lines[0].cast, StagedLine::kDescription);
  EXPECT_NEAR(with.lines[0].seconds, 0.5, 0.02);
  ASSERT_EQ(with.sound.voices.size(), 1u);
  EXPECT_EQ(with.sound.voices[0].bus, audio::Bus::kDescription);
  EXPECT_TRUE(with.sound.voices[0].head_locked);
  EXPECT_NEAR(with.sound.voices[0].began, 1.0, 0.02);
  show->input().SetDescriptions(false);
  EXPECT_TRUE(At(*show, 1.6).sound.voices.empty());
}

TEST_F(ShowTest, TheNextVisitorSeesTheDramaFromItsBeginning) {
  const std::unique_ptr<Show> show = Make();
  StagedFrame staged = At(*show, 0.7);
  EXPECT_NEAR(PositionX(staged), 0.7, 1e-4);
  show->input().RestartAt(0.0);
  EXPECT_NEAR(PositionX(At(*show, 20.0)), 0.0, 1e-4);
  EXPECT_NEAR(PositionX(At(*show, 20.3)), 0.3, 1e-4);
  show->input().RestartAt(0.5);
  EXPECT_NEAR(PositionX(At(*show, 21.0)), 0.5, 1e-4);
  EXPECT_NEAR(PositionX(At(*show, 21.2)), 0.7, 1e-4);
}

TEST_F(ShowTest, AnotherShowGoesOnWhereOneWas) {
  const auto stage = [](Show& show, double capture_time, double time) {
    StagedFrame staged;
    vision::TrackedFrame tracked = test::FakePoses().Track({});
    tracked.frame.capture_time = capture_time;
    show.StageFrame(std::move(tracked), time, staged);
    return staged;
  };
  const std::unique_ptr<Show> before = Make();
  stage(*before, 7.0, 0.0);
  const StagedFrame last = stage(*before, 7.4, 0.4);
  const std::unique_ptr<Show> after = Make();
  ASSERT_TRUE(after->ResumeFrom(*before).ok());
  // A new pipeline counts its times from its first frame.
  const StagedFrame next = stage(*after, 7.5, 0.0);
  EXPECT_NEAR(PositionX(next), PositionX(last), 0.01);
  EXPECT_NEAR(next.sound.frame_time, 0.5, 1e-9);
  EXPECT_NEAR(PositionX(stage(*after, 7.7, 0.2)), 0.6, 0.01);
}

TEST_F(ShowTest, APoseThatIsFoundAnewIsTakenAsItIs) {
  // The change of the pose with which people are drawn, when tracking returns at a different pose
  // after a loss.
  const auto moved = [&](bool forget) {
    const std::unique_ptr<Show> show = Make();
    show->SetTrackingLossFader({});
    StagedFrame staged;
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    for (int i = 0; i < 10; ++i) {
      vision::TrackedFrame frame = test::FakePoses().Track({});
      frame.camera = geometry::CameraModel{64, 48, 50.0, 50.0, 31.5, 23.5};
      frame.frame.capture_time = i / 30.0;
      if (i >= 6 && i < 9) {
        frame.camera_from_map.reset();
      }
      if (i == 9) {
        before = staged.camera.camera_from_stage->Center();
        frame.camera_from_map->translation.x() += 1.5;
        if (forget) {
          show->input().ForgetPose();
        }
      }
      show->StageFrame(frame, i / 30.0, staged);
    }
    EXPECT_NEAR(PositionX(staged), 0.3, 1e-4) << "the drama goes on";
    return (staged.camera.camera_from_stage->Center() - before).norm();
  };
  EXPECT_LT(moved(false), 0.1) << "first they go where they were";
  EXPECT_GT(moved(true), 0.5);
}

TEST_F(ShowTest, AKioskRunsForDays) {
  const std::unique_ptr<Show> show = Make();
  const double days = 5.0 * 24.0 * 3600.0;
  At(*show, 0.0);
  show->input().RestartAt(0.0);
  EXPECT_NEAR(PositionX(At(*show, days)), 0.0, 1e-4);
  EXPECT_NEAR(PositionX(At(*show, days + 0.25)), 0.25, 1e-4);
}

}  // namespace
}  // namespace lararium::show
