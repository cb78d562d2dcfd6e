#include "editor/check/walk_trails.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/stage/test_human.h"

namespace lararium::editor {
namespace {

constexpr double kTick = stage::Stage::kTickSeconds;

// A stage with one person, whom the test moves freely.
class TrailTest : public testing::Test {
 protected:
  TrailTest() : id_(*stage_.Add("keeper", test::MakeTestHuman())), recorder_(stage_) {}

  // Records a tick at which the person is at this position.
  void Be(glm::vec2 place, float heading = 0.0f) {
    stage::ActorState& state = stage_.Find(id_)->state;
    state.visible = true;
    state.position = {place.x, 0.0f, place.y};
    state.heading = heading;
    recorder_.Note(time_);
    time_ += kTick;
  }
  void BeAway() {
    stage_.Find(id_)->state.visible = false;
    recorder_.Note(time_);
    time_ += kTick;
  }
  Trail Take() { return recorder_.Take().front(); }

  stage::Stage stage_;
  stage::ActorId id_;
  TrailRecorder recorder_;
  double time_ = 0.0;
};

TEST_F(TrailTest, KnowsWhereSomebodyWasAtAnyMoment) {
  std::vector<glm::vec2> places;
  for (int i = 0; i < 600; ++i) {
    const double angle = 0.4 * kTick * i;
    places.emplace_back(2.0 * std::cos(angle), 2.0 * std::sin(angle));
    Be(places.back());
  }
  const Trail trail = Take();
  for (size_t i = 0; i < places.size(); ++i) {
    const auto at = trail.At(static_cast<double>(i) * kTick);
    ASSERT_TRUE(at.has_value());
    EXPECT_LT(glm::distance(at->place, places[i]), 0.002f) << i;
  }
  EXPECT_LT(trail.points.size(), 60u);
}

TEST_F(TrailTest, WhoeverStandsLeavesNoPoints) {
  for (int i = 0; i < 12000; ++i) {
    Be({1.0f, 2.0f});
  }
  const Trail trail = Take();
  EXPECT_LE(trail.points.size(), 2u);
  EXPECT_EQ(trail.At(50.0)->place, glm::vec2(1.0f, 2.0f));
}

TEST_F(TrailTest, StandingBetweenTwoWalksIsNoSlowWalk) {
  for (int i = 0; i < 120; ++i) {
    Be({0.01f * static_cast<float>(i), 0.0f});
  }
  for (int i = 0; i < 600; ++i) {
    Be({1.19f, 0.0f});
  }
  for (int i = 1; i < 120; ++i) {
    Be({1.19f, 0.01f * static_cast<float>(i)});
  }
  const Trail trail = Take();
  EXPECT_NEAR(trail.At(5.9)->place.y, 0.0f, 0.002f);
  EXPECT_NEAR(trail.At(6.5)->place.y, 0.6f, 0.02f);
}

TEST_F(TrailTest, NobodyIsAnywhereBeforeTheyCome) {
  BeAway();
  BeAway();
  Be({1.0f, 1.0f});
  const Trail trail = Take();
  EXPECT_FALSE(trail.At(0.0).has_value());
  EXPECT_EQ(trail.At(2 * kTick)->place, glm::vec2(1.0f, 1.0f));
}

TEST_F(TrailTest, AWayBeginsWhereSomebodyWasPlacedNotWhereTheyWereBefore) {
  for (int i = 0; i < 60; ++i) {
    Be({5.0f, 5.0f});
  }
  const double placed = time_;
  for (int i = 0; i < 120; ++i) {
    Be({0.01f * static_cast<float>(i), 0.0f});
  }
  const std::vector<TrailPoint> way = Take().Between(placed - 0.1, placed + 0.5);
  ASSERT_FALSE(way.empty());
  EXPECT_EQ(way.front().place, glm::vec2(0.0f));
  EXPECT_NEAR(way.back().place.x, 0.6f, 0.01f);
  EXPECT_NEAR(way.back().seconds, placed + 0.5, 1e-9);
}

TEST_F(TrailTest, TurningOnTheSpotIsKept) {
  for (int i = 0; i < 120; ++i) {
    Be({0.0f, 0.0f}, 0.02f * static_cast<float>(i));
  }
  EXPECT_NEAR(Take().At(0.5)->heading, 1.2f, 0.03f);
}

}  // namespace
}  // namespace lararium::editor
