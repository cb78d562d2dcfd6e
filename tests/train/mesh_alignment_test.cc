#include "editor/train/mesh_alignment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "shared/core/random.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::train {
namespace {

using Eigen::Vector3d;
using geometry::Similarity3;
using testing::HasSubstr;

const Similarity3 kStageFromMesh = {
    0.01, Eigen::Quaterniond(0.8, 0.1, -0.5, 0.2).normalized(), {1.0, 0.4, -2.0}};

std::vector<MeshPair> Pairs(const std::vector<Vector3d>& on_mesh) {
  std::vector<MeshPair> pairs;
  for (const Vector3d& at : on_mesh) {
    pairs.push_back({at, kStageFromMesh * at});
  }
  return pairs;
}

TEST(AlignByPairs, FindsHowTheModelLies) {
  const auto found =
      AlignByPairs(Pairs({{0, 0, 0}, {100, 0, 0}, {0, 80, 0}, {10, 20, 60}}), std::nullopt);
  ASSERT_TRUE(found.ok()) << found.message();
  EXPECT_NEAR(found->scale, 0.01, 1e-12);
  EXPECT_LT(found->rotation.angularDistance(kStageFromMesh.rotation), 1e-7);
  EXPECT_LT((found->translation - kStageFromMesh.translation).norm(), 1e-9);
}

TEST(AlignByPairs, KeepsAScaleThatIsKnownAndSharesWhatIsLeftOver) {
  std::vector<MeshPair> pairs = Pairs({{0, 0, 0}, {100, 0, 0}, {0, 80, 0}});
  const auto found = AlignByPairs(pairs, 0.011);
  ASSERT_TRUE(found.ok()) << found.message();
  EXPECT_EQ(found->scale, 0.011);
  EXPECT_LT(found->rotation.angularDistance(kStageFromMesh.rotation), 1e-7);
  Vector3d sum = Vector3d::Zero();
  for (const MeshPair& pair : pairs) {
    sum += *found * pair.on_mesh - pair.on_stage;
  }
  EXPECT_LT(sum.norm(), 1e-9);  // A property of least squares.
}

TEST(AlignByPairs, RefusesTooFewAndThoseOnALine) {
  EXPECT_THAT(AlignByPairs(Pairs({{0, 0, 0}, {1, 0, 0}}), std::nullopt).message(),
              HasSubstr("at least 3"));
  EXPECT_THAT(AlignByPairs(Pairs({{0, 0, 0}, {50, 0.1, 0}, {100, 0, 0}}), std::nullopt).message(),
              HasSubstr("on a line"));
  EXPECT_THAT(AlignByPairs(Pairs({{3, 3, 3}, {3, 3, 3}, {3, 3, 3}}), std::nullopt).message(),
              HasSubstr("on a line"));
  std::vector<MeshPair> pairs = Pairs({{0, 0, 0}, {100, 0, 0}, {0, 80, 0}});
  pairs[2].on_stage = kStageFromMesh * Vector3d(50, 0, 0);
  EXPECT_THAT(AlignByPairs(pairs, std::nullopt).message(), HasSubstr("on a line"));
}

TEST(PlaneDistance, HasTheDerivativeThatDifferencesGive) {
  Random random(3);
  const auto vector = [&] {
    return Vector3d{random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-2, 2)};
  };
  for (int i = 0; i < 20; ++i) {
    const SurfacePair pair{vector(), vector(), vector().normalized()};
    const Vector3d center = vector();
    const SurfaceMotion derivative = PlaneDistanceDerivative(pair, center);
    for (int k = 0; k < 7; ++k) {
      constexpr double kStep = 1e-6;
      const SurfaceMotion motion = kStep * SurfaceMotion::Unit(k);
      const double difference =
          (PlaneDistance(pair, center, motion) - PlaneDistance(pair, center, -motion)) /
          (2.0 * kStep);
      EXPECT_NEAR(derivative[k], difference, 1e-7) << "seed 3, pair " << i << ", parameter " << k;
    }
  }
}

// A closed, L-shaped counter made of two boxes, in millimetres.
geometry::TriangleMesh Counter() {
  geometry::TriangleMesh mesh;
  const auto add_box = [&](const Vector3d& least, const Vector3d& most) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (int i = 0; i < 8; ++i) {
      mesh.positions.push_back(geometry::ToGlm(Vector3d((i & 1) != 0 ? most.x() : least.x(),
                                                        (i & 2) != 0 ? most.y() : least.y(),
                                                        (i & 4) != 0 ? most.z() : least.z())));
    }
    for (const uint32_t corner : {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5}) {
      mesh.indices.push_back(first + corner);
    }
  };
  add_box({0, 0, 0}, {2000, 900, 600});
  add_box({0, 0, 600}, {500, 900, 1800});
  return mesh;
}

constexpr double kMillimetre = 0.001;

struct Found {
  std::vector<Vector3d> points;  // stage metres
  Similarity3 stage_from_mesh;   // the truth
};

// Noisy points on the counter, among foreign points all around it and on the floor.
Found Scatter(size_t on_it, double noise_m, double foreign_share, uint64_t seed) {
  Random random(seed);
  const geometry::TriangleMesh mesh = Counter();
  Found found;
  found.stage_from_mesh = {
      kMillimetre, Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d::UnitY())), {0.3, 0.0, -1.2}};
  const auto corner = [&](size_t i) { return geometry::ToEigen(mesh.positions[mesh.indices[i]]); };
  while (found.points.size() < on_it) {
    const size_t i = 3 * random.Below(static_cast<uint32_t>(mesh.indices.size() / 3));
    const double u = random.Uniform();
    const double v = random.Uniform() * (1.0 - u);
    const Vector3d at =
        corner(i) + u * (corner(i + 1) - corner(i)) + v * (corner(i + 2) - corner(i));
    const bool inside = at.z() == 600.0 && at.x() < 500.0;  // Between the two boxes.
    const bool below = at.y() == 0.0;
    if (!inside && !below) {
      const Vector3d noise{random.Normal(), random.Normal(), random.Normal()};
      found.points.push_back(found.stage_from_mesh * at + noise_m * noise);
    }
  }
  const auto foreign =
      static_cast<size_t>(static_cast<double>(on_it) * foreign_share / (1.0 - foreign_share));
  for (size_t i = 0; i < foreign; ++i) {
    const bool floor = i % 3 == 0;
    found.points.push_back(found.stage_from_mesh * Vector3d{random.Uniform(-800, 2800),
                                                            floor ? 0.0 : random.Uniform(0, 1600),
                                                            random.Uniform(-800, 2600)});
  }
  return found;
}

// The truth, rotated by `degrees` about the counter's middle, shifted and scaled.
Similarity3 Offset(const Similarity3& truth, double degrees, const Vector3d& shift, double scale) {
  SurfaceMotion motion;
  motion << degrees * kRadiansPerDegree * Vector3d(0.2, 1.0, -0.3).normalized(), shift,
      std::log(scale);
  return MotionAbout(truth * Vector3d(1000, 450, 600), motion) * truth;
}

// Largest distance of a vertex of the counter from its true position, metres.
double FarthestOff(const Similarity3& stage_from_mesh, const Similarity3& truth) {
  double farthest = 0.0;
  for (const glm::vec3& vertex : Counter().positions) {
    const Vector3d at = geometry::ToEigen(vertex);
    farthest = std::max(farthest, (stage_from_mesh * at - truth * at).norm());
  }
  return farthest;
}

Result<RefineReport> Refine(const Found& found,
                            const Similarity3& start,
                            const RefineOptions& options) {
  NoProgress silent;
  return RefineAlignment(Counter(), start, found.points, options, silent);
}

TEST(RefineAlignment, FindsTheModelAmongForeignPoints) {
  const Found found = Scatter(1500, 0.01, 0.7, 11);
  const Similarity3 start = Offset(found.stage_from_mesh, 3.0, {0.08, -0.03, 0.06}, 1.0);
  ASSERT_GT(FarthestOff(start, found.stage_from_mesh), 0.12);
  const auto report = Refine(found, start, {.search_m = 0.3, .keep_scale = true});
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_LT(FarthestOff(report->stage_from_mesh, found.stage_from_mesh), 0.01);
  EXPECT_EQ(report->stage_from_mesh.scale, start.scale);
  EXPECT_GT(report->points, 1000);
  EXPECT_LT(report->points, 2200);
  EXPECT_GT(report->rms_before_m, 0.04);
  EXPECT_LT(report->rms_after_m, 0.02);
  EXPECT_NEAR(report->moved_m, FarthestOff(start, report->stage_from_mesh), 1e-9);
  EXPECT_EQ(report->undetermined, 0);
  EXPECT_GT(report->covered, 0.7);
}

TEST(RefineAlignment, FindsTheScaleTooAndDoesNotCollapseIt) {
  const Found found = Scatter(1500, 0.01, 0.7, 12);
  const Similarity3 start = Offset(found.stage_from_mesh, 2.0, {0.04, 0.03, -0.05}, 1.05);
  const auto report = Refine(found, start, {.search_m = 0.3});
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_NEAR(report->stage_from_mesh.scale / kMillimetre, 1.0, 0.005);
  EXPECT_LT(FarthestOff(report->stage_from_mesh, found.stage_from_mesh), 0.012);
}

TEST(RefineAlignment, WhatStandsOnItDoesNotLiftIt) {
  // Objects all over the top, as high as the search distance and with as many points as the rest.
  Found found = Scatter(1500, 0.004, 0.2, 19);
  Random random(20);
  for (int i = 0; i < 1500; ++i) {
    found.points.push_back(found.stage_from_mesh * Vector3d{random.Uniform(0, 2000),
                                                            random.Uniform(910, 1200),
                                                            random.Uniform(0, 600)});
  }
  const Similarity3 start = Offset(found.stage_from_mesh, 0.4, {0.008, -0.006, 0.005}, 0.995);
  const auto report = Refine(found, start, {.search_m = 0.3});
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_LT(FarthestOff(report->stage_from_mesh, found.stage_from_mesh), 0.01);
}

TEST(RefineAlignment, LeavesAModelWhereItLiesWellAlready) {
  const Found found = Scatter(1500, 0.0, 0.0, 13);
  const auto report = Refine(found, found.stage_from_mesh, {.search_m = 0.1});
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_LT(report->moved_m, 1e-4);
  EXPECT_LT(report->rms_after_m, 1e-4);
  EXPECT_EQ(report->points, 1500);
}

TEST(RefineAlignment, DoesNotSlideWhereNothingSaysHowFar) {
  geometry::TriangleMesh wall;
  wall.positions = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  wall.indices = {0, 1, 2, 0, 2, 3};
  Random random(14);
  std::vector<Vector3d> points;
  for (int i = 0; i < 500; ++i) {
    points.push_back(
        {random.Uniform(-1, 5), random.Uniform(-1, 4), 0.05 + 0.005 * random.Normal()});
  }
  NoProgress silent;
  const auto report = RefineAlignment(wall, {}, points, {.search_m = 0.2}, silent);
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_EQ(report->undetermined, 4);  // Two shifts, the rotation in the plane, and the scale.
  EXPECT_NEAR(report->stage_from_mesh.translation.z(), 0.05, 0.003);
  EXPECT_LT(report->stage_from_mesh.translation.head<2>().norm(), 0.005);
  EXPECT_NEAR(report->stage_from_mesh.scale, 1.0, 1e-6);
}

TEST(RefineAlignment, SaysHowMuchOfTheSurfaceHasPoints) {
  Found found = Scatter(3000, 0.002, 0.0, 15);
  std::erase_if(found.points, [&](const Vector3d& point) {
    return (found.stage_from_mesh.Inverse() * point).x() > 700.0;
  });
  const auto report = Refine(found, found.stage_from_mesh, {.search_m = 0.1, .keep_scale = true});
  ASSERT_TRUE(report.ok()) << report.message();
  EXPECT_GT(report->covered, 0.3);
  EXPECT_LT(report->covered, 0.7);
}

TEST(RefineAlignment, RefusesWhereTooFewPointsAreNear) {
  const Found found = Scatter(200, 0.0, 0.0, 16);
  const Similarity3 far = Offset(found.stage_from_mesh, 0.0, {0.0, 5.0, 0.0}, 1.0);
  const std::string message = Refine(found, far, {.search_m = 0.25}).message();
  EXPECT_THAT(message, HasSubstr("0 points of the map lie within 0.25 m"));
  EXPECT_THAT(message, HasSubstr("at least 30 are needed"));
  EXPECT_THAT(message, HasSubstr("align it by points"));
}

TEST(RefineAlignment, RefusesToGoFartherThanItLooks) {
  // The far end would have to move farther than the search distance.
  const Found found = Scatter(3000, 0.0, 0.0, 17);
  const Similarity3 start = Offset(found.stage_from_mesh, 12.0, {0.05, 0.0, 0.0}, 1.0);
  ASSERT_GT(FarthestOff(start, found.stage_from_mesh), 0.2);
  const auto report = Refine(found, start, {.search_m = 0.2, .keep_scale = true});
  ASSERT_FALSE(report.ok());
  EXPECT_THAT(report.message(), HasSubstr("farther than the search distance of 0.2 m"));
}

TEST(RefineAlignment, RefusesWhatItCannotWorkWith) {
  const Found found = Scatter(100, 0.0, 0.0, 18);
  EXPECT_THAT(Refine(found, found.stage_from_mesh, {.search_m = 0.0}).message(),
              HasSubstr("search distance"));
  EXPECT_THAT(Refine(found, found.stage_from_mesh, {.search_m = NAN}).message(),
              HasSubstr("search distance"));
  NoProgress silent;
  geometry::TriangleMesh line;
  line.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  line.indices = {0, 1, 2};
  EXPECT_THAT(RefineAlignment(line, {}, found.points, {}, silent).message(),
              HasSubstr("no surface"));
  line.indices = {0, 1, 9};
  EXPECT_FALSE(RefineAlignment(line, {}, found.points, {}, silent).ok());

  class Impatient : public NoProgress {
    bool Cancelled() const override { return true; }
  } impatient;
  EXPECT_THAT(
      RefineAlignment(Counter(), found.stage_from_mesh, found.points, {}, impatient).message(),
      HasSubstr("cancelled"));
}

}  // namespace
}  // namespace lararium::train
