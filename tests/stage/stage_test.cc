#include "shared/stage/stage.h"

#include <gtest/gtest.h>

#include "shared/core/units.h"
#include "shared/stage/place.h"
#include "tests/stage/test_human.h"

namespace lararium::stage {
namespace {

TEST(Stage, NamesAreUnique) {
  Stage stage;
  EXPECT_TRUE(stage.Add("keeper", test::MakeTestHuman()).ok());
  EXPECT_FALSE(stage.Add("keeper", test::MakeTestHuman()).ok());
}

TEST(Stage, AdvanceRunsClipsAndFades) {
  Stage stage;
  const ActorId id = *stage.Add("keeper", test::MakeTestHuman());
  human::Animation& animation = stage.Find(id)->state.animation_state.animation;
  const auto advance = [&stage](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      stage.Advance();
      stage.Perform();
    }
  };
  human::StartClip(animation, 0, 1.0, 0.0f);
  advance(120);
  human::StartClip(animation, 1, 2.0, 0.5f);
  advance(30);
  EXPECT_NEAR(animation.clip_time, 0.5, 1e-9);
  EXPECT_NEAR(animation.previous_time, 1.25, 1e-9);
  EXPECT_NEAR(animation.weight, 0.5f, 1e-5);
  advance(120);
  EXPECT_EQ(animation.weight, 1.0f);
}

TEST(Stage, InterpolatesBetweenSnapshots) {
  StageSnapshot a;
  a.actors = {{{0, 1}, {}}, {{1, 1}, {}}};
  a.actors[0].state.visible = a.actors[1].state.visible = true;
  StageSnapshot b = a;
  b.actors[0].state.position = {0.1f, 0.0f, 0.0f};
  a.actors[0].state.heading = kPiF - 0.1f;
  b.actors[0].state.heading = -kPiF + 0.1f;
  b.actors[0].state.animation_state.animation.clip_time = 1.0;
  b.actors[1].state.position = {3.0f, 0.0f, 0.0f};  // Too far for one tick.
  StageSnapshot between;
  Interpolate(a, b, 0.25f, between);
  EXPECT_FLOAT_EQ(between.actors[0].state.position.x, 0.025f);
  EXPECT_NEAR(between.actors[0].state.heading, kPiF - 0.05f, 1e-5);
  EXPECT_NEAR(between.actors[0].state.animation_state.animation.clip_time, 0.25, 1e-9);
  EXPECT_EQ(between.actors[1].state.position.x, 3.0f);
}

TEST(Stage, InterpolationEndsAtTheCurrentSnapshot) {
  StageSnapshot a;
  a.actors = {{{0, 1}, {}}, {{2, 1}, {}}};
  StageSnapshot b;
  b.actors = {{{0, 2}, {}}, {{1, 1}, {}}, {{2, 1}, {}}};
  b.actors[2].state.position = {0.1f, 0.2f, 0.0f};
  StageSnapshot end;
  Interpolate(a, b, 1.0f, end);
  EXPECT_TRUE(end == b);
}

TEST(Stage, AQuarterTurnFacesMinusX) {
  ActorState state;
  state.position = {1.0f, 2.0f, 3.0f};
  state.heading = kPiF / 2.0f;
  const glm::vec4 ahead = StageFromActor(state) * glm::vec4(0.0f, 0.0f, -1.0f, 1.0f);
  EXPECT_NEAR(ahead.x, 0.0f, 1e-6);
  EXPECT_NEAR(ahead.y, 2.0f, 1e-6);
  EXPECT_NEAR(ahead.z, 3.0f, 1e-6);
}

// A stage with a keeper and lines of the same length.
struct SpeakingStage {
  explicit SpeakingStage(float seconds, std::initializer_list<const char*> lines) {
    human::VisemeTrack track;
    track.duration = seconds;
    for (const char* line : lines) {
      EXPECT_TRUE(stage.AddSpeech(line, track).ok());
    }
  }
  void Advance(double seconds) {
    for (double t = 0.0; t < seconds - 1e-9; t += Stage::kTickSeconds) {
      stage.Advance();
      stage.Perform();
    }
  }

  Stage stage;
  ActorId keeper = *stage.Add("keeper", test::MakeTestHuman());
};

TEST(Stage, ALineTakesTheTimeOfAnotherLanguageWithTheMouthOfItsOwn) {
  SpeakingStage speaking(1.0f, {});
  Stage& stage = speaking.stage;
  human::VisemeTrack own;
  own.keys = {{0.0f, human::Viseme::kAa, 1.0f}};
  own.duration = 1.0f;
  human::VisemeTrack longer;
  longer.keys = {{0.0f, human::Viseme::kOu, 1.0f}};
  longer.duration = 2.0f;
  ASSERT_TRUE(stage.AddSpeech("salvete", own, longer).ok());
  EXPECT_DOUBLE_EQ(stage.SpeechSeconds(0), 2.0);
  EXPECT_EQ(stage.SpeechTrack(0).keys[0].viseme, human::Viseme::kOu);
  stage.Find(speaking.keeper)->state.visible = true;
  stage.Say(speaking.keeper, 0);
  speaking.Advance(0.5);
  const ActorState& state = stage.Find(speaking.keeper)->state;
  const auto& mouth = state.animation_state.face.visemes;
  EXPECT_GT(mouth[static_cast<size_t>(human::Viseme::kAa)], 0.5f);
  EXPECT_EQ(mouth[static_cast<size_t>(human::Viseme::kOu)], 0.0f);
  speaking.Advance(1.0);
  EXPECT_TRUE(state.utterance.speaking);
  speaking.Advance(0.6);
  EXPECT_FALSE(state.utterance.speaking);
}

TEST(Stage, AnUtteranceIsSpokenThenReadOnThenGone) {
  SpeakingStage speaking(1.0f, {"salvete"});
  Stage& stage = speaking.stage;
  const ActorId id = speaking.keeper;
  const auto utterance = [&]() -> const Utterance& { return stage.Find(id)->state.utterance; };
  const auto advance = [&speaking](double seconds) { speaking.Advance(seconds); };
  EXPECT_EQ(utterance(), Utterance());
  stage.Say(id, *stage.FindSpeech("salvete"));
  advance(0.5);
  EXPECT_TRUE(utterance().speaking);
  EXPECT_NEAR(Stage::UtteredSeconds(utterance()), 0.5, 1e-9);
  advance(0.5);
  EXPECT_FALSE(utterance().speaking);
  EXPECT_EQ(utterance().line, 0) << "still to be read";
  stage.Say(id, -1);
  EXPECT_EQ(utterance().line, 0) << "it was said to its end";
  advance(Stage::kReadOnSeconds + 0.1);
  EXPECT_EQ(utterance(), Utterance());

  stage.Say(id, 0);
  advance(0.5);
  stage.Say(id, -1);
  EXPECT_EQ(utterance(), Utterance()) << "broken off";
}

TEST(Stage, WhatIsDescribedWaitsForAPauseOfSpeech) {
  SpeakingStage speaking(1.0f, {"salvete", "d_bar"});
  Stage& stage = speaking.stage;
  const ActorId id = speaking.keeper;
  const auto advance = [&speaking](double seconds) { speaking.Advance(seconds); };
  const auto heard = [&]() -> const Utterance& { return stage.description().heard; };
  stage.Describe(1, 5.0);
  EXPECT_EQ(heard(), Utterance()) << "somebody may begin in the same tick";
  stage.Say(id, 0);
  advance(0.9);
  EXPECT_EQ(heard(), Utterance());
  advance(0.2);
  EXPECT_TRUE(heard().speaking);
  EXPECT_EQ(heard().line, 1);
  // Only one description is heard at a time.
  stage.Describe(1, 5.0);
  advance(0.5);
  EXPECT_EQ(stage.description().waiting, 1);
  advance(0.6);
  EXPECT_EQ(stage.description().waiting, -1);
  EXPECT_NEAR(Stage::UtteredSeconds(heard()), 0.2, 0.05);
  const Stage::Checkpoint then = stage.Save();
  StageSnapshot before;
  stage.Capture(before);
  advance(1.0);
  EXPECT_FALSE(heard().speaking);
  EXPECT_EQ(heard().line, 1) << "still to be read";
  advance(Stage::kReadOnSeconds + 0.1);
  EXPECT_EQ(heard(), Utterance());
  stage.Restore(then);
  StageSnapshot after;
  stage.Capture(after);
  EXPECT_TRUE(before == after);
  stage.Reset();
  EXPECT_EQ(stage.description(), StageDescription());
}

TEST(Stage, WhatFindsNoPauseIsNotDescribed) {
  SpeakingStage speaking(3.0f, {"salvete"});
  Stage& stage = speaking.stage;
  stage.Say(speaking.keeper, 0);
  stage.Describe(0, 2.0);
  for (int tick = 0; tick < 600; ++tick) {
    stage.Advance();
    EXPECT_EQ(stage.description().heard, Utterance());
  }
  EXPECT_EQ(stage.description().waiting, -1);
}

TEST(Place, TheNudgeMovesTheCameraAlongItsAxes) {
  Place place;
  place.map_from_stage.scale = 0.5;
  geometry::Rigid3 camera_from_map;
  camera_from_map.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d before = CameraFromStage(place, camera_from_map).Center();
  place.camera_nudge = {0.0, 0.0, 0.1};
  const geometry::Rigid3 nudged = CameraFromStage(place, camera_from_map);
  const Eigen::Vector3d forward = nudged.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_TRUE((nudged.Center() - before).isApprox(0.1 * forward, 1e-9));
}

TEST(Place, ThePoseInTheMapIsTheOneThatGivesThePoseOnTheStage) {
  Place place;
  place.map_from_stage = {0.5, Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitX())),
                          Eigen::Vector3d(1.0, 2.0, 3.0)};
  place.camera_nudge = {0.1, 0.2, 0.3};
  const geometry::Rigid3 camera_from_map = {
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())),
      Eigen::Vector3d(-0.4, 0.5, 2.0)};
  const geometry::Rigid3 found = CameraFromMap(place, CameraFromStage(place, camera_from_map));
  EXPECT_TRUE(found.translation.isApprox(camera_from_map.translation, 1e-12));
  EXPECT_LT(found.rotation.angularDistance(camera_from_map.rotation), 1e-7);
}

TEST(Place, ThePoseIsMetric) {
  Place place;
  place.map_from_stage.scale = 0.5;  // Map units per metre.
  geometry::Rigid3 camera_from_map;
  camera_from_map.translation = {0.0, 0.0, 2.0};
  EXPECT_TRUE(
      CameraFromStage(place, camera_from_map).translation.isApprox(Eigen::Vector3d(0.0, 0.0, 4.0)));
}

}  // namespace
}  // namespace lararium::stage
