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

TEST(Track, HidesTheActorBeforeItsFirstSegment) {
  EXPECT_EQ(EvaluateTrack(TwoSegments(), 0.99), stage::ActorState());
  EXPECT_EQ(EvaluateTrack({}, 5.0), stage::ActorState());
  EXPECT_TRUE(EvaluateTrack(TwoSegments(), 1.0).visible);
}

TEST(Track, MovesAtConstantSpeedAndStays) {
  const auto segments = TwoSegments();
  EXPECT_EQ(EvaluateTrack(segments, 2.0).position.x, 1.0f);
  EXPECT_EQ(EvaluateTrack(segments, 4.0).position.x, 2.0f);
  EXPECT_EQ(EvaluateTrack(segments, 6.5).position.x, 4.5f);
  EXPECT_EQ(EvaluateTrack(segments, 100.0).position.x, 5.0f);
}

TEST(Track, FadesFromTheClipBeforeWhichPlaysOn) {
  const stage::Animation animation = EvaluateTrack(TwoSegments(), 3.25).animation;
  EXPECT_EQ(animation.clip, 1);
  EXPECT_DOUBLE_EQ(animation.clip_time, 0.125);
  EXPECT_EQ(animation.previous_clip, 0);
  EXPECT_DOUBLE_EQ(animation.previous_time, 2.25);
  EXPECT_FLOAT_EQ(animation.weight, 0.25f);
  EXPECT_EQ(EvaluateTrack(TwoSegments(), 4.0).animation.weight, 1.0f);
}

TEST(Track, TurnsTheShorterWay) {
  auto segments = TwoSegments();
  segments[0].heading = 3.0f;
  segments[1].heading = -3.0f;  // 0.28 rad further, across pi
  const float halfway = EvaluateTrack(segments, 3.25).heading;
  EXPECT_NEAR(std::abs(std::remainder(halfway, 2.0 * std::numbers::pi)), std::numbers::pi, 1e-5);
  EXPECT_FLOAT_EQ(EvaluateTrack(segments, 5.0).heading, -3.0f);
}

}  // namespace
}  // namespace lararium::drama
