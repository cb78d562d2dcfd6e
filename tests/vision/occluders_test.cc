#include "shared/vision/occluders.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "shared/core/random.h"

namespace lararium::vision {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

Vector3f RandomPoint(Random& random, double reach) {
  return Vector3f{static_cast<float>(random.Uniform(-reach, reach)),
                  static_cast<float>(random.Uniform(-reach, reach)),
                  static_cast<float>(random.Uniform(-reach, reach))};
}

OccluderMesh RandomTriangles(uint64_t seed, int count) {
  Random random(seed);
  OccluderMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vector3f middle = RandomPoint(random, 1.0);
    for (int k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(middle + RandomPoint(random, 0.2));
    }
  }
  return mesh;
}

// A square of side 2 in the plane z = height.
OccluderMesh Square(float height) {
  return {{{-1, -1, height}, {1, -1, height}, {1, 1, height}, {-1, 1, height}}, {0, 1, 2, 0, 2, 3}};
}

// Reference implementation: solves corner + u e1 + v e2 = eye + t way for every triangle.
bool HidesBySolving(const OccluderMesh& mesh,
                    const Vector3d& eye,
                    const Vector3d& point,
                    double bias) {
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vector3d a = mesh.positions[mesh.indices[i]].cast<double>();
    const Vector3d b = mesh.positions[mesh.indices[i + 1]].cast<double>();
    const Vector3d c = mesh.positions[mesh.indices[i + 2]].cast<double>();
    Eigen::Matrix3d matrix;
    matrix << b - a, c - a, eye - point;
    const Vector3d uvt = matrix.fullPivLu().solve(eye - a);
    const double behind = std::abs((b - a).cross(c - a).normalized().dot(point - a));
    if (uvt.x() >= 0.0 && uvt.y() >= 0.0 && uvt.x() + uvt.y() <= 1.0 && uvt.z() > 0.0 &&
        uvt.z() < 1.0 && behind > bias) {
      return true;
    }
  }
  return false;
}

TEST(OccluderTree, HidesWhatSolvingForEveryTriangleSays) {
  const OccluderMesh mesh = RandomTriangles(3, 400);
  const OccluderTree tree(mesh);
  Random random(4);
  int hidden = 0;
  int different = 0;
  constexpr int kRays = 1000;
  for (int i = 0; i < kRays; ++i) {
    const Vector3f eye = RandomPoint(random, 2.0);
    const Vector3f point = RandomPoint(random, 1.0);
    const bool expected = HidesBySolving(mesh, eye.cast<double>(), point.cast<double>(), 0.05);
    hidden += expected ? 1 : 0;
    different += tree.Hides(eye, point, 0.05f) != expected ? 1 : 0;
  }
  EXPECT_GT(hidden, kRays / 5);
  EXPECT_LT(hidden, kRays * 19 / 20);
  EXPECT_LE(different, 2);  // Rounding may decide at an edge.
}

TEST(OccluderTree, DoesNotHideItsOwnSurfaceNorWhatLiesBeforeIt) {
  const OccluderTree tree(Square(0.0f));
  for (const float slant : {0.0f, 1.0f, 10.0f}) {  // Viewing angles down to 6 degrees.
    const Vector3f eye(slant, 0.0f, 1.0f);
    EXPECT_FALSE(tree.Hides(eye, {0.2f, 0.1f, 0.0f}, 0.01f));
    EXPECT_FALSE(tree.Hides(eye, {0.2f, 0.1f, -0.009f}, 0.01f));
    EXPECT_FALSE(tree.Hides(eye, {0.2f, 0.1f, 0.5f}, 0.01f));
    EXPECT_TRUE(tree.Hides(eye, {0.2f, 0.1f, -0.011f}, 0.01f));
  }
  EXPECT_FALSE(tree.Hides({0, 0, 1}, {1.2f, 0.0f, -0.1f}, 0.01f));  // The ray passes its edge.
  EXPECT_FALSE(OccluderTree(OccluderMesh()).Hides({0, 0, 1}, {0, 0, -1}, 0.01f));
}

TEST(OccluderTree, TheFirstHitIsTheNearestOfAllTriangles) {
  const OccluderMesh mesh = RandomTriangles(5, 300);
  const OccluderTree tree(mesh);
  std::vector<OccluderTree> alone;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    alone.emplace_back(
        OccluderMesh{mesh.positions, {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]}});
  }
  Random random(6);
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3f eye = RandomPoint(random, 2.0);
    const Vector3f direction = (RandomPoint(random, 0.5) - eye).normalized();
    const float nearest = i % 2 == 0 ? 0.0f : 1.0f;
    std::optional<OccluderTree::Hit> expected;
    for (const OccluderTree& triangle : alone) {
      const auto hit = triangle.FirstHit(eye, direction, nearest, 3.0f);
      if (hit && (!expected || hit->distance < expected->distance)) {
        expected = hit;
      }
    }
    const auto hit = tree.FirstHit(eye, direction, nearest, 3.0f);
    ASSERT_EQ(hit.has_value(), expected.has_value()) << "seed 6, ray " << i;
    if (hit) {
      ++hits;
      EXPECT_EQ(hit->distance, expected->distance);
      EXPECT_EQ(hit->normal, expected->normal);
      EXPECT_GE(hit->distance, nearest);
    }
  }
  EXPECT_GT(hits, 50);
}

TEST(OccluderTree, AHitLiesOnTheTriangleAndIsAsFarAsItSays) {
  const auto hit = OccluderTree(Square(0.5f)).FirstHit({0.2f, 0.1f, 2.0f}, {0, 0, -1}, 0.1f, 10.0f);
  ASSERT_TRUE(hit.has_value());
  EXPECT_FLOAT_EQ(hit->distance, 1.5f);
  EXPECT_FLOAT_EQ(std::abs(hit->normal.z()), 1.0f);
}

// Distance from a point to the nearest of many sample points of a triangle.
double NearestBySampling(const Vector3f* corners, const Vector3f& point) {
  constexpr int kSteps = 400;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; i + j <= kSteps; ++j) {
      const float u = static_cast<float>(i) / kSteps;
      const float v = static_cast<float>(j) / kSteps;
      const Vector3f at = (1.0f - u - v) * corners[0] + u * corners[1] + v * corners[2];
      least = std::min(least, static_cast<double>((at - point).norm()));
    }
  }
  return least;
}

TEST(OccluderTree, TheNearestPointOfATriangleIsNearerThanAnyOther) {
  Random random(7);
  for (int i = 0; i < 40; ++i) {
    OccluderMesh mesh{
        {RandomPoint(random, 1.0), RandomPoint(random, 1.0), RandomPoint(random, 1.0)}, {0, 1, 2}};
    const Vector3f point = RandomPoint(random, 2.0);
    const auto nearest = OccluderTree(mesh).NearestTo(point, 10.0f);
    ASSERT_TRUE(nearest.has_value());
    const double expected = NearestBySampling(mesh.positions.data(), point);
    EXPECT_LE(nearest->distance, expected + 1e-5) << "seed 7, triangle " << i;
    EXPECT_GE(nearest->distance, expected - 0.005) << "seed 7, triangle " << i;
    EXPECT_NEAR((nearest->point - point).norm(), nearest->distance, 1e-5f);
    // The result is a point of the triangle.
    EXPECT_LT(NearestBySampling(mesh.positions.data(), nearest->point), 0.005);
  }
}

TEST(OccluderTree, TheNearestPointIsThatOfTheNearestOfAllTriangles) {
  const OccluderMesh mesh = RandomTriangles(8, 300);
  const OccluderTree tree(mesh);
  std::vector<OccluderTree> alone;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    alone.emplace_back(
        OccluderMesh{mesh.positions, {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]}});
  }
  Random random(9);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3f point = RandomPoint(random, 1.5);
    constexpr float kWithin = 0.2f;
    float expected = kWithin;
    for (const OccluderTree& triangle : alone) {
      if (const auto nearest = triangle.NearestTo(point, expected)) {
        expected = nearest->distance;
      }
    }
    const auto nearest = tree.NearestTo(point, kWithin);
    ASSERT_EQ(nearest.has_value(), expected < kWithin) << "seed 9, point " << i;
    if (nearest) {
      ++found;
      EXPECT_EQ(nearest->distance, expected);
    }
  }
  EXPECT_GT(found, 50);
  EXPECT_LT(found, 250);
  EXPECT_FALSE(OccluderTree(OccluderMesh()).NearestTo({0, 0, 0}, 1e9f));
}

TEST(OccluderTree, LeavesOutTrianglesWithoutArea) {
  OccluderMesh mesh = Square(0.0f);
  mesh.indices = {0, 1, 1, 2, 2, 2};
  EXPECT_FALSE(OccluderTree(mesh).Hides({0, 0, 1}, {0, 0, -1}, 0.01f));
}

TEST(OccluderSet, BelievesAnOccluderOnceWhatItHidesIsNotSeen) {
  OccluderSet set;
  set.Set(std::vector<OccluderMesh>{Square(0.0f)});
  const uint32_t hider = set.HiddenBy({0, 0, 1}, {0, 0, -1}, 0.01);
  ASSERT_EQ(hider, 0u);
  EXPECT_EQ(set.HiddenBy({0, 0, 1}, {0, 0, 0.5}, 0.01), OccluderSet::kNone);
  EXPECT_FALSE(set.believed(hider));
  for (int i = 0; i < 10; ++i) {
    set.Note(hider, false);
  }
  EXPECT_TRUE(set.believed(hider));
  EXPECT_TRUE(set.Doubt());
  EXPECT_FALSE(set.believed(hider));
  EXPECT_FALSE(set.Doubt());
}

TEST(OccluderSet, StopsBelievingOneThatIsWrongHoweverLongItWasRight) {
  OccluderSet set;
  set.Set(std::vector<OccluderMesh>{Square(0.0f)});
  for (int i = 0; i < 10000; ++i) {
    set.Note(0, i % 10 == 0);  // A few points are found past an edge.
  }
  EXPECT_TRUE(set.believed(0));
  int more = 0;
  while (set.believed(0) && more < 1000) {
    set.Note(0, true);
    ++more;
  }
  EXPECT_LT(more, 40);
}

TEST(OccluderSet, PrefersTheOneThatIsBelieved) {
  OccluderSet set;
  set.Set(std::vector<OccluderMesh>{Square(0.2f), Square(0.0f)});
  EXPECT_EQ(set.HiddenBy({0, 0, 1}, {0, 0, -1}, 0.01), 0u);
  for (int i = 0; i < 10; ++i) {
    set.Note(1, false);
  }
  EXPECT_EQ(set.HiddenBy({0, 0, 1}, {0, 0, -1}, 0.01), 1u);
  EXPECT_EQ(set.HiddenBy({0, 0, 1}, {0, 0, 0.1}, 0.01), 0u);
}

}  // namespace
}  // namespace lararium::vision
