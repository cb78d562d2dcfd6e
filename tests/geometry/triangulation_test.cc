#include "shared/geometry/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "shared/core/random.h"

namespace lararium::geometry {
namespace {

// Cameras on an arc about the origin, looking at it from distance 5.
std::vector<Rigid3> Arc(int count, double total_angle) {
  std::vector<Rigid3> cameras;
  for (int i = 0; i < count; ++i) {
    const double angle = total_angle * i / (count - 1);
    const Eigen::Quaterniond rotation = RotationFromVector({0.0, angle, 0.0});
    cameras.push_back({rotation, Eigen::Vector3d(0.0, 0.0, 5.0)});
  }
  return cameras;
}

std::vector<Eigen::Vector2d> Views(const std::vector<Rigid3>& cameras,
                                   const Eigen::Vector3d& point) {
  std::vector<Eigen::Vector2d> views;
  for (const Rigid3& camera : cameras) {
    views.push_back((camera * point).hnormalized());
  }
  return views;
}

TEST(Triangulation, RecoversExactPoints) {
  Random random(1);
  const std::vector<Rigid3> cameras = Arc(4, 0.8);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d point{random.Uniform(-1, 1), random.Uniform(-1, 1),
                                random.Uniform(-1, 1)};
    const auto found = TriangulatePoint(cameras, Views(cameras, point));
    ASSERT_TRUE(found);
    EXPECT_LT((*found - point).norm(), 1e-9);
  }
}

TEST(Triangulation, MinimisesTheErrorOnThePlane) {
  Random random(2);
  const std::vector<Rigid3> cameras = Arc(5, 0.6);
  std::vector<Eigen::Vector2d> views = Views(cameras, {0.3, -0.2, 0.4});
  for (Eigen::Vector2d& view : views) {
    view += 1e-3 * Eigen::Vector2d{random.Normal(), random.Normal()};
  }
  const auto error = [&](const Eigen::Vector3d& point) {
    double sum = 0.0;
    const std::vector<Eigen::Vector2d> projected = Views(cameras, point);
    for (size_t i = 0; i < views.size(); ++i) {
      sum += (projected[i] - views[i]).squaredNorm();
    }
    return sum;
  };
  const auto found = TriangulatePoint(cameras, views);
  ASSERT_TRUE(found);
  const double least = error(*found);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double step : {-1e-4, 1e-4}) {
      EXPECT_GT(error(*found + step * Eigen::Vector3d::Unit(axis)), least);
    }
  }
}

TEST(Triangulation, RefusesASingleView) {
  const std::vector<Rigid3> camera(1);
  const std::vector<Eigen::Vector2d> view(1, Eigen::Vector2d::Zero());
  EXPECT_FALSE(TriangulatePoint(camera, view));
}

TEST(Triangulation, RefusesViewsFromOneCentre) {
  const std::vector<Rigid3> cameras = {Rigid3{},
                                       Rigid3{RotationFromVector({0, 0.1, 0}), {0, 0, 0}}};
  EXPECT_FALSE(TriangulatePoint(cameras, Views(cameras, {0.1, 0.2, 3.0})));
}

TEST(Triangulation, RefusesPointsBehindACamera) {
  const std::vector<Rigid3> cameras = {Rigid3{}, Rigid3{Eigen::Quaterniond::Identity(), {1, 0, 0}}};
  EXPECT_FALSE(TriangulatePoint(cameras, Views(cameras, {0.3, 0.1, -4.0})));
}

TEST(TriangulationAngle, IsExactForRightAndTinyAngles) {
  EXPECT_NEAR(TriangulationAngle({1, 0, 0}, {0, 1, 0}, {0, 0, 0}), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(TriangulationAngle({1, 0, 0}, {1, 1e-9, 0}, {0, 0, 0}), 1e-9, 1e-18);
  EXPECT_NEAR(TriangulationAngle({1, 0, 0}, {-1, 0, 0}, {0, 0, 0}), std::numbers::pi, 1e-15);
  const Eigen::Vector3d centers[] = {{1, 0, 0}, {1, 0.1, 0}, {0, 1, 0}};
  EXPECT_NEAR(WidestAngle(centers, {0, 0, 0}), std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(WidestAngle(std::span(centers).first(1), {0, 0, 0}), 0.0);
}

}  // namespace
}  // namespace lararium::geometry
