#include "editor/session/point_trails.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lararium::editor {
namespace {

using Eigen::Vector2f;
using testing::ElementsAre;

TEST(PointTrails, GrowWhileAPointIsSeenAndEndWhereItIsNot) {
  PointTrails trails;
  trails.Add(5, 0, std::vector<vision::SeenPoint>{{7, {1, 1}}, {3, {2, 2}}});
  trails.Add(6, 0, std::vector<vision::SeenPoint>{{7, {1, 2}}, {9, {5, 5}}});
  trails.Add(7, 0, std::vector<vision::SeenPoint>{{3, {2, 4}}, {7, {1, 3}}});
  ASSERT_EQ(trails.trails().size(), 2u);
  EXPECT_EQ(trails.trails()[0].point, 3u);
  // The point was not observed in between.
  EXPECT_THAT(trails.trails()[0].pixels, ElementsAre(Vector2f(2, 4)));
  EXPECT_EQ(trails.trails()[1].point, 7u);
  EXPECT_THAT(trails.trails()[1].pixels,
              ElementsAre(Vector2f(1, 3), Vector2f(1, 2), Vector2f(1, 1)));
}

TEST(PointTrails, KeepOnlyTheLastFrames) {
  PointTrails trails;
  for (int frame = 0; frame < 40; ++frame) {
    trails.Add(frame, 0,
               std::vector<vision::SeenPoint>{{1, Vector2f(static_cast<float>(frame), 0.0f)}});
  }
  ASSERT_EQ(trails.trails()[0].pixels.size(), PointTrails::kLongest);
  EXPECT_EQ(trails.trails()[0].pixels.front().x(), 39.0f);
  EXPECT_EQ(trails.trails()[0].pixels.back().x(), 40.0f - PointTrails::kLongest);
}

TEST(PointTrails, BeginAnewAfterALeapInTimeAndInAnotherMap) {
  const std::vector<vision::SeenPoint> seen = {{1, {0, 0}}};
  PointTrails trails;
  trails.Add(0, 0, seen);
  trails.Add(1, 0, seen);
  EXPECT_EQ(trails.trails()[0].pixels.size(), 2u);
  trails.Add(8, 0, seen);
  EXPECT_EQ(trails.trails()[0].pixels.size(), 1u);
  trails.Add(9, 1, seen);
  EXPECT_EQ(trails.trails()[0].pixels.size(), 1u);
  trails.Add(10, 1, {});
  EXPECT_TRUE(trails.trails().empty());
}

}  // namespace
}  // namespace lararium::editor
