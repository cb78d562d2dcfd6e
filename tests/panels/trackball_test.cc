#include "editor/panels/viewport/trackball.h"

#include <gtest/gtest.h>

#include <numbers>

namespace lararium::panels {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector2d kCenter(200.0, 150.0);
constexpr double kRadius = 100.0;

TEST(Trackball, PointsLieOnTheUnitBallInFrontAndOnTheRimBeside) {
  const Trackball ball(kCenter, kRadius);
  EXPECT_TRUE(ball.PointOnBall(kCenter).isApprox(Vector3d::UnitZ()));
  EXPECT_TRUE(ball.PointOnBall(kCenter + Vector2d(300.0, 0.0)).isApprox(Vector3d::UnitX()));
  EXPECT_TRUE(ball.PointOnBall(kCenter - Vector2d(0.0, 300.0)).isApprox(Vector3d::UnitY()));
  EXPECT_NEAR(ball.PointOnBall(kCenter + Vector2d(31.0, -47.0)).norm(), 1.0, 1e-12);
}

TEST(Trackball, ADragTurnsByTwiceItsArc) {
  const Trackball ball(kCenter, kRadius);
  const Eigen::Quaterniond turn = ball.Turn(kCenter, kCenter + Vector2d(kRadius, 0.0));
  EXPECT_NEAR(std::abs(turn.w()), 0.0, 1e-12);  // A quarter arc gives half a turn.
  const double half = kRadius * std::sin(0.2);
  const Eigen::AngleAxisd small(ball.Turn(kCenter, kCenter + Vector2d(half, 0.0)));
  EXPECT_NEAR(small.angle(), 0.4, 1e-12);
  EXPECT_TRUE(small.axis().isApprox(Vector3d::UnitY()));
}

TEST(Trackball, TheFrontFollowsThePointer) {
  const Trackball ball(kCenter, kRadius);
  const Vector3d front = Vector3d::UnitZ();
  EXPECT_GT((ball.Turn(kCenter, kCenter + Vector2d(20.0, 0.0)) * front).x(), 0.0);
  EXPECT_GT((ball.Turn(kCenter, kCenter + Vector2d(0.0, -20.0)) * front).y(), 0.0);
}

TEST(Trackball, ClosedDragsLeaveNoTurnBehind) {
  // Shoemake's reason for doubling the arc: consecutive arcs compose.
  const Trackball ball(kCenter, kRadius);
  const Vector2d a = kCenter + Vector2d(-40.0, 10.0);
  const Vector2d b = kCenter + Vector2d(25.0, 60.0);
  EXPECT_TRUE((ball.Turn(b, a) * ball.Turn(a, b)).isApprox(Eigen::Quaterniond::Identity()));
  EXPECT_TRUE(ball.Turn(a, a).isApprox(Eigen::Quaterniond::Identity()));
}

}  // namespace
}  // namespace lararium::panels
