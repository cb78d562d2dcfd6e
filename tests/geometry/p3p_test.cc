#include "shared/geometry/p3p.h"

#include <gtest/gtest.h>

#include <limits>

#include "shared/core/random.h"

namespace lararium::geometry {
namespace {

using Eigen::Vector3d;

Vector3d RandomVector(Random& random) {
  return {random.Normal(), random.Normal(), random.Normal()};
}

Rigid3 RandomPose(Random& random) {
  return {Eigen::Quaterniond{random.Normal(), random.Normal(), random.Normal(), random.Normal()}
              .normalized(),
          RandomVector(random)};
}

struct Case {
  Rigid3 camera_from_world;
  std::array<Vector3d, 3> rays;
  std::array<Vector3d, 3> points;
};

Case CaseOf(const Rigid3& camera_from_world, const std::array<Vector3d, 3>& in_camera) {
  Case c{camera_from_world, {}, {}};
  for (int i = 0; i < 3; ++i) {
    c.rays[i] = in_camera[i].normalized();
    c.points[i] = camera_from_world.Inverse() * in_camera[i];
  }
  return c;
}

Case RandomCase(Random& random, double depth) {
  std::array<Vector3d, 3> in_camera;
  for (Vector3d& p : in_camera) {
    const double z = depth * random.Uniform(0.5, 1.5);
    p = {z * random.Uniform(-0.6, 0.6), z * random.Uniform(-0.5, 0.5), z};
  }
  return CaseOf(RandomPose(random), in_camera);
}

double Distance(const Rigid3& a, const Rigid3& b) {
  return a.rotation.angularDistance(b.rotation) + (a.translation - b.translation).norm();
}

double ClosestDistance(const P3pSolutions& solutions, const Rigid3& truth) {
  double closest = std::numeric_limits<double>::infinity();
  for (const Rigid3& pose : solutions.poses()) {
    closest = std::min(closest, Distance(pose, truth));
  }
  return closest;
}

double LargestRayError(const Case& c, const Rigid3& pose) {
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    largest = std::max(largest, ((pose * c.points[i]).normalized() - c.rays[i]).norm());
  }
  return largest;
}

TEST(P3p, FindsTheTruePoseAmongAtMostFour) {
  Random random(7);
  int missed = 0;
  constexpr int kCases = 20000;
  for (int i = 0; i < kCases; ++i) {
    const Case c = RandomCase(random, 4.0);
    const P3pSolutions solutions = SolveP3p(c.rays, c.points);
    ASSERT_LE(solutions.count, 4);
    missed += ClosestDistance(solutions, c.camera_from_world) > 1e-5 ? 1 : 0;
  }
  // Samples next to the danger cylinder lose digits, and then the root.
  EXPECT_LE(missed, kCases / 2000);
}

TEST(P3p, EverySolutionSeesThePointsAlongTheRays) {
  Random random(8);
  for (int i = 0; i < 20000; ++i) {
    const Case c = RandomCase(random, 4.0);
    const P3pSolutions solutions = SolveP3p(c.rays, c.points);
    for (const Rigid3& pose : solutions.poses()) {
      ASSERT_LT(LargestRayError(c, pose), 1e-5) << "case " << i;
      ASSERT_NEAR(pose.rotation.norm(), 1.0, 1e-12);
    }
  }
}

TEST(P3p, DoesNotDependOnTheScaleOfTheWorld) {
  for (const double depth : {1e-4, 1e-2, 1e2, 1e4}) {
    Random random(9);
    int missed = 0;
    for (int i = 0; i < 2000; ++i) {
      Case c = RandomCase(random, depth);
      c.camera_from_world.translation *= depth;
      for (int k = 0; k < 3; ++k) {
        c.points[k] = c.camera_from_world.Inverse() * (c.rays[k] * (depth * (1.0 + 0.1 * k)));
      }
      const double error = ClosestDistance(SolveP3p(c.rays, c.points), c.camera_from_world);
      missed += error > 1e-5 * std::max(depth, 1.0) ? 1 : 0;
    }
    EXPECT_LE(missed, 4) << "depth " << depth;
  }
}

TEST(P3p, SolvesSymmetricTriangles) {
  Random random(10);
  for (const double tilt : {0.0, 0.1, 0.7}) {
    std::array<Vector3d, 3> in_camera;
    for (int k = 0; k < 3; ++k) {
      const double angle = 2.0 * EIGEN_PI * k / 3.0;
      in_camera[k] = Eigen::AngleAxisd(tilt, Vector3d::UnitX()) *
                         Vector3d(std::cos(angle), std::sin(angle), 0.0) +
                     Vector3d(0.0, 0.0, 4.0);
    }
    const Case c = CaseOf(RandomPose(random), in_camera);
    EXPECT_LT(ClosestDistance(SolveP3p(c.rays, c.points), c.camera_from_world), 1e-4)
        << "tilt " << tilt;
  }
}

TEST(P3p, GivesNothingForDegenerateInput) {
  Random random(11);
  const Case c = RandomCase(random, 4.0);
  Case line = c;
  line.points[2] = 0.5 * (line.points[0] + line.points[1]);
  EXPECT_EQ(SolveP3p(line.rays, line.points).count, 0);
  Case same_point = c;
  same_point.points[1] = same_point.points[0];
  EXPECT_EQ(SolveP3p(same_point.rays, same_point.points).count, 0);
  Case same_ray = c;
  same_ray.rays[1] = same_ray.rays[0];
  EXPECT_EQ(SolveP3p(same_ray.rays, same_ray.points).count, 0);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Case broken = c;
    broken.points[1].y() = bad;
    EXPECT_EQ(SolveP3p(broken.rays, broken.points).count, 0);
    broken = c;
    broken.rays[2].x() = bad;
    EXPECT_EQ(SolveP3p(broken.rays, broken.points).count, 0);
  }
}

TEST(P3p, SurvivesRaysThatNoTriangleFits) {
  Random random(12);
  for (int i = 0; i < 20000; ++i) {
    Case c = RandomCase(random, 4.0);
    for (Vector3d& ray : c.rays) {
      ray = RandomVector(random).normalized();
    }
    const P3pSolutions solutions = SolveP3p(c.rays, c.points);
    for (const Rigid3& pose : solutions.poses()) {
      ASSERT_LT(LargestRayError(c, pose), 1e-3);
    }
  }
}

}  // namespace
}  // namespace lararium::geometry
