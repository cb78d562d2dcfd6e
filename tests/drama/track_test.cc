#include "shared/drama/track.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lararium::drama {
namespace {

std::vector<TrackSegment> TwoSegments() {
  TrackSegment first;
  first.begin = 1.0;
  first.length = 2.0;
  first.clip = 0;
  first.from = first.to = {1.0f, 0.0f, 0.0f};
  TrackSegment second;
  second.begin = 3.0;
  second.length = 4.0;
  second.clip = 1;
  second.rate = 0.5;
  second.fade = 1.0;
  second.from = {1.0f, 0.0f, 0.0f};
  second.to = {5.0f, 0.0f, 0.0f};
  second.heading = -std::numbers::pi_v<float> / 2.0f;
  return {first, second};
}

stage::ActorState Evaluate(std::span<const TrackSegment> segments, double time) {
  stage::ActorState state;
  ApplyTrack(segments, time, state);
  return state;
}

TEST(Track, HidesTheActorBeforeItsFirstSegment) {
  EXPECT_FALSE(Evaluate(TwoSegments(), 0.99).visible);
  EXPECT_FALSE(Evaluate({}, 5.0).visible);
  EXPECT_TRUE(Evaluate(TwoSegments(), 1.0).visible);
}

TEST(Track, LeavesAloneWhatTheBodyDoesBesides) {
  stage::ActorState state;
  state.animation_state.face.visemes[3] = 0.5f;
  state.animation_state.animation.previous_clip = 7;
  ApplyTrack(TwoSegments(), 1.5, state);
  EXPECT_EQ(state.animation_state.face.visemes[3], 0.5f);
  EXPECT_EQ(state.animation_state.animation.previous_clip, human::Animation::kNoClip);
}

TEST(Track, MovesAtConstantSpeedAndStays) {
  const auto segments = TwoSegments();
  EXPECT_EQ(Evaluate(segments, 2.0).position.x, 1.0f);
  EXPECT_EQ(Evaluate(segments, 4.0).position.x, 2.0f);
  EXPECT_EQ(Evaluate(segments, 6.5).position.x, 4.5f);
  EXPECT_EQ(Evaluate(segments, 100.0).position.x, 5.0f);
}

TEST(Track, FadesFromTheClipBeforeWhichPlaysOn) {
  const human::Animation animation = Evaluate(TwoSegments(), 3.25).animation_state.animation;
  EXPECT_EQ(animation.clip, 1);
  EXPECT_DOUBLE_EQ(animation.clip_time, 0.125);
  EXPECT_EQ(animation.previous_clip, 0);
  EXPECT_DOUBLE_EQ(animation.previous_time, 2.25);
  EXPECT_FLOAT_EQ(animation.weight, 0.25f);
  EXPECT_EQ(Evaluate(TwoSegments(), 4.0).animation_state.animation.weight, 1.0f);
}

TEST(Track, TurnsTheShorterWay) {
  auto segments = TwoSegments();
  segments[0].heading = 3.0f;
  segments[1].heading = -3.0f;  // 0.28 rad further, across pi
  const float halfway = Evaluate(segments, 3.25).heading;
  EXPECT_NEAR(std::abs(std::remainder(halfway, 2.0 * std::numbers::pi)), std::numbers::pi, 1e-5);
  EXPECT_FLOAT_EQ(Evaluate(segments, 5.0).heading, -3.0f);
}

}  // namespace
}  // namespace lararium::drama
