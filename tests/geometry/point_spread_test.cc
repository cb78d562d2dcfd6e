#include "shared/geometry/point_spread.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "shared/core/random.h"

namespace lararium::geometry {
namespace {

TEST(SpreadOf, FindsTheAxesAndDeviationsOfATurnedCloud) {
  Random random(1);
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()));
  const Eigen::Vector3d center(3.0, -2.0, 5.0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20000; ++i) {
    points.push_back(center + turn * Eigen::Vector3d{0.1 * random.Normal(), 4.0 * random.Normal(),
                                                     random.Normal()});
  }
  const PointSpread spread = SpreadOf(points);
  EXPECT_LT((spread.mean - center).norm(), 0.1);
  EXPECT_NEAR(spread.deviations[0], 0.1, 0.01);
  EXPECT_NEAR(spread.deviations[1], 1.0, 0.03);
  EXPECT_NEAR(spread.deviations[2], 4.0, 0.1);
  EXPECT_GT(std::abs(spread.axes.col(0).dot(turn * Eigen::Vector3d::UnitX())), 0.9999);
  EXPECT_GT(std::abs(spread.axes.col(2).dot(turn * Eigen::Vector3d::UnitY())), 0.999);
}

TEST(SpreadOf, IsFlatOnAPlaneAndZeroWithoutPoints) {
  const std::vector<Eigen::Vector3d> square = {{0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  const PointSpread spread = SpreadOf(square);
  EXPECT_LT(spread.deviations[0], 1e-12);
  EXPECT_NEAR(std::abs(spread.axes(2, 0)), 1.0, 1e-12);
  EXPECT_EQ(SpreadOf({}).deviations, Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace lararium::geometry
