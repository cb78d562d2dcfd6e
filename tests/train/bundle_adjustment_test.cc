#include "editor/train/bundle_adjustment.h"

#include <gtest/gtest.h>

#include <array>

#include "shared/core/random.h"
#include "shared/vision/rolling_shutter.h"
#include "tests/train/synthetic_world.h"

namespace lararium::train {
namespace {

using synthetic::MakeWorld;
using synthetic::World;

geometry::CameraModel DistortedCamera() {
  geometry::CameraModel camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = 520.0;
  camera.fy = 540.0;
  camera.cx = 310.0;
  camera.cy = 250.0;
  camera.k1 = -0.2;
  camera.k2 = 0.05;
  camera.p1 = 1e-3;
  camera.p2 = -2e-3;
  return camera;
}

ImageMotion SomeMotion() {
  ImageMotion motion;
  motion << 0.03, -0.02, 0.04, 0.05, 0.1, -0.08;
  return motion;
}

struct Arguments {
  IntrinsicsBlock intrinsics = ToIntrinsicsBlock(DistortedCamera(), {0.3, 0.8});
  PoseBlock pose{};
  std::array<double, 3> point = {0.4, -0.3, 0.2};
};

Arguments SomeArguments() {
  Arguments arguments;
  const Eigen::Quaterniond rotation = geometry::RotationFromVector({0.3, -0.5, 0.2});
  arguments.pose = {rotation.x(), rotation.y(), rotation.z(), rotation.w(), 0.1, -0.2, 2.5};
  return arguments;
}

Eigen::Vector2d Residual(const Arguments& a) {
  Eigen::Vector2d residual;
  EXPECT_TRUE(ReprojectionResidual(DistortedCamera(), SomeMotion(), {300.0, 200.0},
                                   a.intrinsics.data(), a.pose.data(), a.point.data(),
                                   residual.data(), nullptr, nullptr, nullptr));
  return residual;
}

TEST(ReprojectionResidual, IsTheProjectionOfTheCameraModel) {
  const Arguments a = SomeArguments();
  geometry::Rigid3 pose;
  pose.rotation.coeffs() = Eigen::Map<const Eigen::Vector4d>(a.pose.data());
  pose.translation = Eigen::Map<const Eigen::Vector3d>(a.pose.data() + 4);
  // The camera moves on until the pixel is exposed.
  const Eigen::Vector2d observed(300.0, 200.0);
  const double time =
      Eigen::Vector2d(0.3, 0.8).dot(vision::ReadoutOrder(DistortedCamera(), observed));
  const auto pixel = DistortedCamera().Project(vision::PoseAfter(pose, SomeMotion(), time) *
                                               Eigen::Vector3d(0.4, -0.3, 0.2));
  ASSERT_TRUE(pixel);
  EXPECT_LT((Residual(a) + observed - *pixel).norm(), 0.01);  // The turn is of second order.
}

TEST(ReprojectionResidual, JacobiansMatchCentralDifferences) {
  Arguments a = SomeArguments();
  Eigen::Vector2d residual;
  Eigen::Matrix<double, 2, kIntrinsics, Eigen::RowMajor> by_intrinsics;
  Eigen::Matrix<double, 2, 7, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, 2, 3, Eigen::RowMajor> by_point;
  ASSERT_TRUE(ReprojectionResidual(
      DistortedCamera(), SomeMotion(), {300.0, 200.0}, a.intrinsics.data(), a.pose.data(),
      a.point.data(), residual.data(), by_intrinsics.data(), by_pose.data(), by_point.data()));
  const auto slope = [&](double& number) {
    const double before = number;
    constexpr double kStep = 1e-6;
    number = before + kStep;
    const Eigen::Vector2d above = Residual(a);
    number = before - kStep;
    const Eigen::Vector2d below = Residual(a);
    number = before;
    return Eigen::Vector2d((above - below) / (2.0 * kStep));
  };
  for (int i = 0; i < kIntrinsics; ++i) {
    EXPECT_LT((by_intrinsics.col(i) - slope(a.intrinsics[i])).norm(), 1e-5) << i;
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT((by_point.col(i) - slope(a.point[i])).norm(), 1e-4) << i;
  }
  for (int i = 0; i < 7; ++i) {
    EXPECT_LT((by_pose.col(i) - slope(a.pose[i])).norm(), 1e-4) << i;
  }
}

TEST(ReprojectionResidual, RefusesPointsBehindTheCamera) {
  Arguments a = SomeArguments();
  a.pose[6] = -5.0;
  Eigen::Vector2d residual;
  EXPECT_FALSE(ReprojectionResidual(DistortedCamera(), SomeMotion(), {300.0, 200.0},
                                    a.intrinsics.data(), a.pose.data(), a.point.data(),
                                    residual.data(), nullptr, nullptr, nullptr));
}

// The true map with disturbed poses and points.
Reconstruction Disturbed(const World& world, Random& random) {
  const auto pairs = world.Pairs(11, world.camera);
  Reconstruction reconstruction = world.Unsolved(pairs, world.camera);
  for (uint32_t image = 0; image < world.pixels.size(); ++image) {
    reconstruction.Locate(image, world.camera_from_world[image]);
  }
  for (uint32_t track = 0; track < reconstruction.tracks().size(); ++track) {
    reconstruction.Triangulate(track, {});
  }
  for (uint32_t image = 1; image < world.pixels.size(); ++image) {
    geometry::Rigid3 pose = world.camera_from_world[image];
    pose.rotation = geometry::RotationFromVector(
                        {0.01 * random.Normal(), 0.01 * random.Normal(), 0.01 * random.Normal()}) *
                    pose.rotation;
    pose.translation += 0.02 * Eigen::Vector3d{random.Normal(), random.Normal(), random.Normal()};
    reconstruction.Locate(image, pose);
  }
  return reconstruction;
}

TEST(AdjustAll, ReturnsADisturbedMapToTheTruth) {
  Random random(7);
  const World world = MakeWorld({.images = 6, .points = 100, .noise_px = 0.0});
  Reconstruction reconstruction = Disturbed(world, random);
  BundleOptions options;
  options.max_iterations = 100;
  options.function_tolerance = 1e-14;
  ASSERT_TRUE(AdjustAll(reconstruction, {0, 5}, options));
  EXPECT_LT(world.CenterError(reconstruction), 1e-5);
}

TEST(AdjustAll, KeepsTheAnchorsAndTheirDistance) {
  Random random(8);
  const World world = MakeWorld({.images = 6, .points = 100});
  Reconstruction reconstruction = Disturbed(world, random);
  const auto distance = [&] {
    return (reconstruction.camera_from_map(5).Center() - reconstruction.camera_from_map(0).Center())
        .norm();
  };
  const double before = distance();
  const Eigen::Vector3d center = reconstruction.camera_from_map(0).Center();
  ASSERT_TRUE(AdjustAll(reconstruction, {0, 5}, {}));
  EXPECT_NEAR(distance(), before, 1e-9);
  EXPECT_LT((reconstruction.camera_from_map(0).Center() - center).norm(), 1e-9);
}

TEST(AdjustAll, OfFewPointsStillMovesTheOthers) {
  Random random(9);
  const World world = MakeWorld({.images = 6, .points = 200, .noise_px = 0.0});
  Reconstruction reconstruction = Disturbed(world, random);
  BundleOptions options;
  options.max_iterations = 100;
  options.function_tolerance = 1e-14;
  options.points_per_image = 60;
  ASSERT_TRUE(AdjustAll(reconstruction, {0, 5}, options));
  EXPECT_LT(world.CenterError(reconstruction), 1e-5);
  for (uint32_t track = 0; track < reconstruction.tracks().size(); ++track) {
    for (const uint32_t element : reconstruction.Observations(track)) {
      EXPECT_LT(reconstruction.SquaredErrorPx(element, reconstruction.Point(track)), 1e-4);
    }
  }
}

TEST(AdjustLocally, MovesOnlyTheImagesNamed) {
  Random random(10);
  const World world = MakeWorld({.images = 6, .points = 100});
  Reconstruction reconstruction = Disturbed(world, random);
  const Eigen::Vector3d center_1 = reconstruction.camera_from_map(1).Center();
  const Eigen::Vector3d center_3 = reconstruction.camera_from_map(3).Center();
  const std::array<uint32_t, 1> images = {3};
  ASSERT_TRUE(AdjustLocally(reconstruction, images, {}));
  EXPECT_EQ(reconstruction.camera_from_map(1).Center(), center_1);
  EXPECT_NE(reconstruction.camera_from_map(3).Center(), center_3);
}

TEST(AdjustPose, FindsThePoseDespiteOutliers) {
  const World world = MakeWorld({.images = 1, .points = 200, .noise_px = 0.2});
  std::vector<Eigen::Vector2d> pixels = world.pixels[0];
  std::vector<Eigen::Vector3d> points;
  for (const uint32_t point : world.point_of[0]) {
    points.push_back(world.points[point]);
  }
  for (size_t i = 0; i < pixels.size(); i += 10) {
    pixels[i].x() += 20.0;
  }
  geometry::Rigid3 start = world.camera_from_world[0];
  start.translation.x() += 0.02;
  const auto view = AdjustView({world.camera}, pixels, points, start, {});
  ASSERT_TRUE(view);
  EXPECT_EQ(view->camera, world.camera);
  EXPECT_LT((view->camera_from_map.Center() - world.camera_from_world[0].Center()).norm(), 4e-3);
}

}  // namespace
}  // namespace lararium::train
