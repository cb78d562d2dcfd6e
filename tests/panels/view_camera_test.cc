#include "editor/panels/viewport/view_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lararium::panels {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

OrbitCamera SomeOrbit() {
  OrbitCamera orbit;
  orbit.target = Vector3d(0.3, 0.5, -0.2);
  orbit.distance = 4.0;
  return orbit;
}

TEST(ViewCamera, RaysPassThroughWhatTheirPixelShows) {
  const ViewCamera view = SomeOrbit().View({10.0, 20.0}, {800.0, 600.0});
  const Vector3d point(0.7, -0.1, 0.4);
  const std::optional<Vector2d> pixel = view.Project(point);
  ASSERT_TRUE(pixel.has_value());
  const Ray ray = view.RayThrough(*pixel);
  const double along = (point - ray.origin).dot(ray.direction);
  EXPECT_TRUE(ray.At(along).isApprox(point, 1e-9));
}

TEST(ViewCamera, PointsBehindAreNotProjected) {
  const ViewCamera view = SomeOrbit().View({0.0, 0.0}, {800.0, 600.0});
  EXPECT_FALSE(view.Project(view.RayThrough({400.0, 300.0}).At(-1.0)).has_value());
}

TEST(OrbitCamera, LooksAtItsTargetWithTheWorldUpright) {
  const OrbitCamera orbit = SomeOrbit();
  const ViewCamera view = orbit.View({0.0, 0.0}, {800.0, 600.0});
  EXPECT_TRUE(view.Project(orbit.target)->isApprox(Vector2d(400.0, 300.0), 1e-9));
  const Vector2d above = *view.Project(orbit.target + Vector3d(0.0, 0.1, 0.0));
  EXPECT_NEAR(above.x(), 400.0, 1e-9);
  EXPECT_LT(above.y(), 300.0);
  EXPECT_NEAR((orbit.CameraFromWorld().Center() - orbit.target).norm(), orbit.distance, 1e-12);
}

TEST(OrbitCamera, AtZeroLooksAlongMinusZ) {
  OrbitCamera orbit;
  orbit.azimuth = 0.0;
  orbit.elevation = 0.0;
  const ViewCamera view = orbit.View({0.0, 0.0}, {800.0, 600.0});
  EXPECT_TRUE(view.RayThrough({400.0, 300.0}).direction.isApprox(-Vector3d::UnitZ(), 1e-12));
  EXPECT_GT(view.Project({0.5, 0.0, 0.0})->x(), 400.0);
}

TEST(OrbitCamera, PanKeepsTheTargetPlaneBelowThePointer) {
  OrbitCamera orbit = SomeOrbit();
  const Vector2d size(800.0, 600.0);
  const Vector3d point = orbit.target;
  const Vector2d drag(37.0, -21.0);
  const Vector2d before = *orbit.View({0.0, 0.0}, size).Project(point);
  orbit.Pan(drag, size.y());
  const Vector2d after = *orbit.View({0.0, 0.0}, size).Project(point);
  EXPECT_TRUE((after - before).isApprox(drag, 1e-9));
}

TEST(OrbitCamera, LookingAtABallShowsAllOfItAndNotMuchElseInAWideAndInATallView) {
  const Ball ball{Vector3d(3.0, -1.0, 2.0), 0.7};
  for (const Vector2d& size : {Vector2d(900.0, 300.0), Vector2d(300.0, 900.0)}) {
    OrbitCamera orbit = SomeOrbit();
    const double azimuth = orbit.azimuth;
    orbit.LookAt(ball, size);
    EXPECT_EQ(orbit.azimuth, azimuth) << "from where it looked";
    const ViewCamera view = orbit.View({0.0, 0.0}, size);
    EXPECT_TRUE(view.Project(ball.center)->isApprox(0.5 * size, 1e-9));
    // The distance of the ball's rim from the centre of the view.
    const double rim = view.focal_x * std::tan(std::asin(ball.radius / orbit.distance));
    EXPECT_NEAR(rim, 150.0, 1e-6);
  }
}

TEST(OrbitCamera, ComesNoNearerAndGoesNoFurtherThanZoomingDoes) {
  OrbitCamera orbit;
  orbit.LookAt({Vector3d::Zero(), 0.0}, {800.0, 600.0});
  EXPECT_EQ(orbit.distance, OrbitCamera::kNearest);
  orbit.LookAt({Vector3d::Zero(), 1e9}, {800.0, 600.0});
  EXPECT_EQ(orbit.distance, OrbitCamera::kFarthest);
}

TEST(BallAround, LeavesOutThePointsThatLieFarFromAllOthers) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 100; ++i) {
    const float angle = 0.0628f * static_cast<float>(i);
    points.emplace_back(2.0f + std::cos(angle), 0.5f, std::sin(angle));
  }
  points.emplace_back(500.0f, 3.0f, 0.0f);
  points.emplace_back(0.0f, -800.0f, 70.0f);
  const std::optional<Ball> ball = BallAround(points);
  ASSERT_TRUE(ball.has_value());
  EXPECT_LT((ball->center - Vector3d(2.0, 0.5, 0.0)).norm(), 0.1);
  EXPECT_NEAR(ball->radius, 1.0, 0.1);
  EXPECT_FALSE(BallAround({}).has_value());
}

}  // namespace
}  // namespace lararium::panels
