#include "player/benchmark/benchmark_alignment.h"

#include <gtest/gtest.h>

#include "shared/core/random.h"
#include "tests/player/benchmark_world.h"

namespace lararium::player {
namespace {

using geometry::Rigid3;
using geometry::Similarity3;

double Apart(const Similarity3& a, const Similarity3& b) {
  return std::abs(std::log(a.scale / b.scale)) + a.rotation.angularDistance(b.rotation) +
         (a.translation - b.translation).norm();
}

double MeanError(const test::BenchmarkWorld& world, const Similarity3& world_from_map) {
  double sum = 0.0;
  size_t count = 0;
  for (const PosePair& pair : world.pairs) {
    const auto visible = VisiblePoints(world.points, pair.camera, pair.camera_from_world);
    for (const double error : RegistrationErrors(
             visible, pair.camera, CameraFromWorld(pair.camera_from_map, world_from_map))) {
      sum += error;
      ++count;
    }
  }
  return sum / static_cast<double>(count);
}

TEST(BenchmarkAlignmentTest, FindsTheSimilarityOfExactPoses) {
  const test::BenchmarkWorld world = test::MakeBenchmarkWorld(20, 0.0, 1);
  EXPECT_LT(Apart(AlignOnCentres(world.pairs)->world_from_map, world.world_from_map), 1e-9);
  EXPECT_LT(Apart(AlignOnPoints(world.pairs, world.points)->world_from_map, world.world_from_map),
            1e-8);
  EXPECT_LT(MeanError(world, world.world_from_map), 1e-9);
}

TEST(BenchmarkAlignmentTest, AFewWrongPosesDoNotSpoilIt) {
  test::BenchmarkWorld world = test::MakeBenchmarkWorld(30, 0.0, 2);
  for (int i = 0; i < 9; ++i) {
    world.pairs[3 * i].camera_from_map.translation += Eigen::Vector3d(1.0 + i, -2.0, 0.5);
  }
  const Alignment alignment = AlignOnPoints(world.pairs, world.points).value();
  EXPECT_LT(Apart(alignment.world_from_map, world.world_from_map), 1e-6);
  for (int i = 0; i < 30; ++i) {
    EXPECT_EQ(alignment.inliers[i], i % 3 != 0 || i >= 27) << i;
  }
}

TEST(BenchmarkAlignmentTest, OnPointsIsTheBetterFitToThePixels) {
  const test::BenchmarkWorld world = test::MakeBenchmarkWorld(12, 0.01, 3);
  const double centres = MeanError(world, AlignOnCentres(world.pairs)->world_from_map);
  const double points = MeanError(world, AlignOnPoints(world.pairs, world.points)->world_from_map);
  EXPECT_LT(points, centres);
}

TEST(BenchmarkAlignmentTest, OrientationsServeWhereTheCentresDoNotFixTheRotation) {
  test::BenchmarkWorld world = test::MakeBenchmarkWorld(20, 0.0, 4);
  world.pairs.resize(2);
  EXPECT_LT(Apart(AlignOnCentres(world.pairs)->world_from_map, world.world_from_map), 1e-9);
  EXPECT_FALSE(AlignOnCentres({}));
}

TEST(BenchmarkAlignmentTest, VisiblePointsAreInsideTheImageAndNotWhereTheLensFoldsBack) {
  geometry::CameraModel camera{640, 480, 500, 500, 319.5, 239.5};
  camera.k1 = -0.3;
  camera.k2 = 0.02;
  const std::vector<Eigen::Vector3d> points = {
      {0, 0, 2}, {0, 0, -2}, {0.5, 0, 1}, {9.0, 0, 1}, {3.4, 0, 1}};
  const auto visible = VisiblePoints(points, camera, Rigid3());
  ASSERT_EQ(visible.size(), 2u);
  EXPECT_EQ(visible[0].in_world, points[0]);
  EXPECT_EQ(visible[1].in_world, points[2]);
}

TEST(BenchmarkAlignmentTest, ErrorsAreCappedAtTheDiagonal) {
  const geometry::CameraModel camera{640, 480, 500, 500, 319.5, 239.5};
  const auto visible = VisiblePoints(std::vector<Eigen::Vector3d>{{0, 0, 2}}, camera, Rigid3());
  Rigid3 aside;
  aside.translation.x() = 0.04;
  EXPECT_NEAR(RegistrationErrors(visible, camera, aside).front(), 10.0, 1e-9);
  Rigid3 behind;
  behind.translation.z() = -5.0;
  EXPECT_EQ(RegistrationErrors(visible, camera, behind).front(), 800.0);
}

}  // namespace
}  // namespace lararium::player
