#include "player/fleet/floor_plan.h"

#include <gmock/gmock.h>

namespace lararium::player {
namespace {

using ::testing::ElementsAre;
using Cell = std::array<double, 2>;

TEST(FloorPlan, HasTheSquaresAboveWhichTheMapHasPointsThatStandOnTheFloor) {
  const std::vector<Eigen::Vector3f> points = {
      {0.52f, 1.0f, -0.21f}, {0.58f, 1.2f, -0.29f},  // Both lie in the same square.
      {2.0f, 1.0f, 2.0f},                            // A point alone.
      {3.0f, 0.01f, 3.0f},   {3.0f, 0.02f, 3.0f},    // The floor.
      {4.0f, 3.0f, 4.0f},    {4.0f, 3.1f, 4.0f},     // The ceiling.
      {-1.0f, 2.0f, 0.05f},  {-0.95f, 1.0f, 0.05f},  // Another square.
  };
  EXPECT_THAT(PlanOf(points, {}), ElementsAre(Cell{-1.0, 0.0}, Cell{0.5, -0.3}));
}

TEST(FloorPlan, IsInMetresOfTheStage) {
  // The map is twice as large as the place and lies elsewhere.
  const geometry::Similarity3 map_from_stage = {2.0, Eigen::Quaterniond::Identity(), {10, 0, 0}};
  const std::vector<Eigen::Vector3f> points = {{12.1f, 2.0f, 2.1f}, {12.1f, 2.2f, 2.1f}};
  EXPECT_THAT(PlanOf(points, map_from_stage), ElementsAre(Cell{1.0, 1.0}));
}

TEST(FloorPlan, PointsThatAreNoNumbersOrFarAwayAreLeftOut) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Eigen::Vector3f> points = {
      {nan, 1.0f, 0.0f}, {nan, 1.0f, 0.0f}, {1e30f, 1.0f, 0.0f}, {1e30f, 1.0f, 0.0f}};
  EXPECT_THAT(PlanOf(points, {}), ElementsAre());
}

}  // namespace
}  // namespace lararium::player
