#include "shared/geometry/radial_pose.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "shared/core/random.h"

namespace lararium::geometry {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kHalfSize = 640.0;

struct FivePointView {
  Rigid3 camera_from_world;
  double focal = 0.0;
  double division = 0.0;
  std::array<Vector2d, 5> pixels;
  std::array<Vector3d, 5> points;
};

// The pixel of the division model: r / (1 + division r^2) is the undistorted distance.
Vector2d Distorted(const Vector2d& undistorted, double division) {
  const double r = undistorted.norm();
  const double root = std::sqrt(1.0 - 4.0 * division * r * r);
  return undistorted * (2.0 / (1.0 + root));
}

FivePointView RandomView(Random& random, bool planar, double division) {
  FivePointView c;
  c.camera_from_world.rotation =
      Eigen::Quaterniond{random.Normal(), random.Normal(), random.Normal(), random.Normal()}
          .normalized();
  c.camera_from_world.translation = {random.Normal(), random.Normal(), random.Normal()};
  c.focal = kHalfSize * std::exp(random.Uniform(-0.7, 1.0));
  c.division = division;
  // The plane of a wall that is seen at a slant.
  const Vector3d normal{random.Uniform(0.3, 0.8), random.Uniform(0.3, 0.8), 1.0};
  for (int i = 0; i < 5; ++i) {
    const Vector2d undistorted{kHalfSize * random.Uniform(-0.9, 0.9),
                               kHalfSize * random.Uniform(-0.5, 0.5)};
    const Vector3d ray = (undistorted / c.focal).homogeneous();
    const double depth = planar ? 4.0 / normal.dot(ray) : random.Uniform(2.0, 6.0);
    c.points[i] = c.camera_from_world.Inverse() * Vector3d(depth * ray);
    c.pixels[i] = Distorted(undistorted, division);
  }
  return c;
}

// The smallest difference of a solution from the truth: of the rotation in radians, of the position
// and of the focal length relative to its size.
double LeastError(const FivePointView& c) {
  const RadialPoseSolutions found = SolveRadialPose(c.pixels, c.points, kHalfSize);
  double least = std::numeric_limits<double>::infinity();
  for (const RadialPose& one : found.all()) {
    const Rigid3& pose = one.camera_from_world;
    least = std::min(least, pose.rotation.angularDistance(c.camera_from_world.rotation) +
                                0.2 * (pose.translation - c.camera_from_world.translation).norm() +
                                std::abs(std::log(one.focal / c.focal)));
  }
  return least;
}

struct Setting {
  bool planar;
  double division;
};

class RadialPoseOf : public testing::TestWithParam<Setting> {};

TEST_P(RadialPoseOf, FindsPoseAndFocalLengthOfExactPixels) {
  Random random(3);
  std::vector<double> errors;
  for (int i = 0; i < 2000; ++i) {
    errors.push_back(LeastError(RandomView(random, GetParam().planar, GetParam().division)));
  }
  std::sort(errors.begin(), errors.end());
  // Distortion is held to be improbable, so some samples trade it for another focal length.
  EXPECT_LT(errors[errors.size() / 2], GetParam().division == 0.0 ? 1e-6 : 0.02);
  EXPECT_LT(errors[errors.size() * 9 / 10], GetParam().division == 0.0 ? 1e-3 : 0.2);
}

INSTANTIATE_TEST_SUITE_P(Views,
                         RadialPoseOf,
                         testing::Values(Setting{false, 0.0},
                                         Setting{true, 0.0},
                                         Setting{false, -0.15 / (kHalfSize * kHalfSize)},
                                         Setting{false, 0.10 / (kHalfSize * kHalfSize)}));

TEST(RadialPose, AFewHundredthsOfAPixelMoveTheFocalLengthLittle) {
  Random random(5);
  std::vector<double> errors;
  for (int i = 0; i < 1000; ++i) {
    FivePointView c = RandomView(random, false, 0.0);
    for (Vector2d& pixel : c.pixels) {
      pixel += 0.03 * Vector2d{random.Normal(), random.Normal()};
    }
    errors.push_back(LeastError(c));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.02);
}

TEST(RadialPose, PointsThatCoincideOrPixelsAtThePrincipalPointGiveNoPose) {
  Random random(9);
  FivePointView c = RandomView(random, false, 0.0);
  std::array<Vector3d, 5> same;
  same.fill(c.points[0]);
  EXPECT_EQ(SolveRadialPose(c.pixels, same, kHalfSize).count, 0);
  std::array<Vector2d, 5> middle = c.pixels;
  middle[2].setZero();
  EXPECT_EQ(SolveRadialPose(middle, c.points, kHalfSize).count, 0);
  c.points[1].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(SolveRadialPose(c.pixels, c.points, kHalfSize).count, 0);
}

}  // namespace
}  // namespace lararium::geometry
