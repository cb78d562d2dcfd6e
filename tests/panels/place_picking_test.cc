#include "editor/panels/viewport/place_picking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace lararium::panels {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

ViewCamera PickingView() {
  OrbitCamera orbit;
  orbit.distance = 4.0;
  return orbit.View({20.0, 10.0}, {800.0, 600.0});
}

// The point at a pixel of a view, at a distance.
Vector3f At(const ViewCamera& view, const Vector2d& pixel, double distance) {
  return view.RayThrough(pixel).At(distance).cast<float>();
}

TEST(PointBelow, TakesTheOneInFrontOfThoseBelowThePointer) {
  const ViewCamera view = PickingView();
  const std::vector<Vector3f> points = {At(view, {300, 200}, 5.0), At(view, {301, 201}, 3.0),
                                        At(view, {305, 200}, 1.0)};
  EXPECT_EQ(PointBelow(points, view, {300, 200}, 3.0, 8.0), 1u);
}

TEST(PointBelow, TakesTheNearestBesideThePointer) {
  const ViewCamera view = PickingView();
  const std::vector<Vector3f> points = {At(view, {307, 200}, 2.0), At(view, {300, 206}, 5.0)};
  EXPECT_EQ(PointBelow(points, view, {300, 200}, 3.0, 8.0), 1u);
  EXPECT_FALSE(PointBelow(points, view, {320, 200}, 3.0, 8.0).has_value());
}

TEST(PointBelow, SeesNothingBehindTheEye) {
  const ViewCamera view = PickingView();
  const std::vector<Vector3f> points = {At(view, {300, 200}, -2.0)};
  EXPECT_FALSE(PointBelow(points, view, {300, 200}, 3.0, 8.0).has_value());
}

TEST(ChoosePoint, ChoosesOneAndThenTheOtherEnd) {
  std::vector<uint32_t> chosen;
  ChoosePoint(7, false, chosen);
  EXPECT_EQ(chosen, (std::vector<uint32_t>{7}));
  ChoosePoint(7, true, chosen);  // A point has no distance to itself.
  EXPECT_EQ(chosen, (std::vector<uint32_t>{7}));
  ChoosePoint(9, true, chosen);
  ChoosePoint(4, true, chosen);  // Replaces the other end.
  EXPECT_EQ(chosen, (std::vector<uint32_t>{7, 4}));
  ChoosePoint(5, false, chosen);
  EXPECT_EQ(chosen, (std::vector<uint32_t>{5}));
  ChoosePoint(std::nullopt, true, chosen);
  EXPECT_TRUE(chosen.empty());
}

TEST(Frustum, IsNearWhereItsLinesAreDrawn) {
  const ViewCamera view = PickingView();
  geometry::CameraModel camera{.width = 640, .height = 480, .fx = 500.0, .fy = 500.0};
  camera.cx = 319.5;
  camera.cy = 239.5;
  const geometry::Rigid3 camera_from_world{
      Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d::UnitY())), Vector3d(0.1, 0.2, 0.3)};
  const Frustum frustum(camera, camera_from_world, 0.5);
  EXPECT_NEAR((frustum.eye - camera_from_world.Center()).norm(), 0.0, 1e-12);
  for (const Vector3d& corner : frustum.corners) {
    EXPECT_NEAR(DistancePx(frustum, view, *view.Project(corner)), 0.0, 1e-9);
    EXPECT_NEAR((camera_from_world * corner).z(), 0.5, 1e-12);
  }
  // The frustum ends at the outer borders of the image's pixels.
  const Vector2d first =
      camera.PixelFromPlane((camera_from_world * frustum.corners[0]).hnormalized());
  EXPECT_NEAR((first - Vector2d(-0.5, -0.5)).norm(), 0.0, 1e-9);
  EXPECT_GT(DistancePx(frustum, view, *view.Project(frustum.eye) + Vector2d(90, 70)), 20.0);
}

TEST(Frustum, IsNowhereBehindTheView) {
  ViewCamera view = PickingView();
  view.camera_from_world.translation.z() -= 9.0;
  const Frustum frustum({.width = 64, .height = 48, .fx = 50.0, .fy = 50.0}, {}, 0.5);
  EXPECT_TRUE(std::isinf(DistancePx(frustum, view, {400, 300})));
}

}  // namespace
}  // namespace lararium::panels
