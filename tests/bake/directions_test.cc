#include "editor/bake/directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/core/random.h"

namespace lararium::bake {
namespace {

SobolSeeds DrawSeeds(Random& random) { return {random.Next(), random.Next(), random.Next()}; }

// The property of a (0, 2)-sequence: of its first 256 points, one is in each cell of every grid
// of 256 cells.
TEST(Directions, ShuffledPointsFillEveryGridEvenly) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const SobolSeeds seeds = DrawSeeds(random);
    for (const uint32_t columns : {1u, 4u, 16u, 64u, 256u}) {
      std::array<int, 256> points = {};
      for (uint32_t i = 0; i < 256; ++i) {
        const glm::vec2 point = ShuffledSobolPoint(i, seeds);
        ASSERT_GE(std::min(point.x, point.y), 0.0f);
        ASSERT_LT(std::max(point.x, point.y), 1.0f);
        const auto column = static_cast<uint32_t>(point.x * static_cast<float>(columns));
        const auto row = static_cast<uint32_t>(point.y * static_cast<float>(256 / columns));
        ++points[row * columns + column];
      }
      for (const int count : points) {
        EXPECT_EQ(count, 1) << columns << " columns";
      }
    }
  }
}

// A path draws several pairs with one index. The position of one pair must not depend on the
// other; otherwise functions of both are integrated only along a line of their space.
TEST(Directions, PointsOfDifferentSeedsAreIndependent) {
  constexpr uint32_t kPoints = 1024;
  Random random(4);
  double squares = 0.0;
  constexpr int kTrials = 64;
  for (int trial = 0; trial < kTrials; ++trial) {
    const SobolSeeds first = DrawSeeds(random);
    const SobolSeeds second = DrawSeeds(random);
    int both = 0;
    for (uint32_t i = 0; i < kPoints; ++i) {
      const bool low = ShuffledSobolPoint(i, first).x < 0.5f;
      both += low && ShuffledSobolPoint(i, second).x < 0.5f ? 1 : 0;
    }
    const double off = both / static_cast<double>(kPoints) - 0.25;
    squares += off * off;
  }
  // Independent pairs give 0.25 / sqrt(1024), equal pairs 0.25.
  EXPECT_LT(std::sqrt(squares / kTrials), 0.03);
}

}  // namespace
}  // namespace lararium::bake
