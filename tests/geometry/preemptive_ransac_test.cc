#include "shared/geometry/preemptive_ransac.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lararium::geometry {
namespace {

struct Point {
  double x, y;
};
struct Line {
  double slope, offset;
};

// Points on y = 2 x - 1, except a share of outliers at random positions.
std::vector<Point> PointsOnLine(int count, double outlier_share, Random& random) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double x = random.Uniform(-1.0, 1.0);
    const bool outlier = random.Uniform() < outlier_share;
    points.push_back(
        {x, outlier ? random.Uniform(-3.0, 3.0) : 2.0 * x - 1.0 + 0.01 * random.Normal()});
  }
  return points;
}

struct LineProblem {
  std::vector<Point> points;
  int samples = 0;
  int scores = 0;

  auto Generate() {
    return [this](Random& random, std::vector<Line>& lines) {
      ++samples;
      const Point a = points[random.Below(static_cast<uint32_t>(points.size()))];
      const Point b = points[random.Below(static_cast<uint32_t>(points.size()))];
      if (std::abs(a.x - b.x) > 1e-3) {
        const double slope = (b.y - a.y) / (b.x - a.x);
        lines.push_back({slope, a.y - slope * a.x});
      }
    };
  }
  auto Cost() {
    return [this](const Line& line, uint32_t i) {
      ++scores;
      return std::min(std::abs(line.slope * points[i].x + line.offset - points[i].y), 0.05);
    };
  }
};

TEST(PreemptiveRansac, FindsTheLineAmongSeventyPercentOutliers) {
  for (uint64_t seed = 1; seed <= 50; ++seed) {
    Random random(seed);
    LineProblem problem{PointsOnLine(400, 0.7, random)};
    PreemptiveRansac<Line> ransac;
    const auto winner =
        ransac.Run(problem.points.size(), {.seed = seed}, problem.Generate(), problem.Cost());
    ASSERT_TRUE(winner.has_value());
    EXPECT_NEAR(winner->slope, 2.0, 0.1) << "seed " << seed;
    EXPECT_NEAR(winner->offset, -1.0, 0.05) << "seed " << seed;
  }
}

TEST(PreemptiveRansac, TakesTheSameTimeForAnyNumberOfObservations) {
  constexpr int kHypotheses = 256;
  constexpr int kBlock = 32;
  for (const int count : {500, 5000, 50000}) {
    Random random(3);
    LineProblem problem{PointsOnLine(count, 0.5, random)};
    PreemptiveRansac<Line> ransac;
    ASSERT_TRUE(ransac.Run(problem.points.size(), {kHypotheses, kBlock, 1}, problem.Generate(),
                           problem.Cost()));
    EXPECT_LE(problem.samples, kHypotheses);
    // M B (1 + 1/2 + 1/4 + ...)
    EXPECT_LE(problem.scores, 2 * kHypotheses * kBlock);
  }
}

TEST(PreemptiveRansac, RepeatsItselfFromOneSeed) {
  Random random(4);
  LineProblem problem{PointsOnLine(300, 0.6, random)};
  PreemptiveRansac<Line> ransac;
  const auto first = ransac.Run(300, {.seed = 9}, problem.Generate(), problem.Cost());
  const auto second = ransac.Run(300, {.seed = 9}, problem.Generate(), problem.Cost());
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->slope, second->slope);
  EXPECT_EQ(first->offset, second->offset);
}

TEST(PreemptiveRansac, FindsNothingWithoutHypothesesOrObservations) {
  PreemptiveRansac<Line> ransac;
  const auto never = [](Random&, std::vector<Line>&) {};
  const auto always = [](Random&, std::vector<Line>& lines) { lines.push_back({1.0, 0.0}); };
  const auto cost = [](const Line&, uint32_t) { return 1.0; };
  EXPECT_FALSE(ransac.Run(10, {}, never, cost));
  EXPECT_FALSE(ransac.Run(0, {}, always, cost));
  EXPECT_TRUE(ransac.Run(1, {}, always, cost));
}

}  // namespace
}  // namespace lararium::geometry
