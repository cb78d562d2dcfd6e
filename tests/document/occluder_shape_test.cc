#include "editor/document/occluder_shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "shared/core/json.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"
#include "shared/vision/occluders.h"

namespace lararium::editor {
namespace {

using Eigen::Vector3d;
using geometry::TriangleMesh;
using testing::HasSubstr;
using Kind = OccluderShape::Kind;
// Area and circumference of a regular polygon with kRoundSides corners on a circle of radius 1.
const double kPolygonArea = 0.5 * kRoundSides * std::sin(2.0 * kPi / kRoundSides);
const double kPolygonLength = 2.0 * kRoundSides * std::sin(kPi / kRoundSides);

Vector3d CornerOf(const TriangleMesh& mesh, size_t index) {
  return geometry::ToEigen(mesh.positions[mesh.indices[index]]);
}

double Volume(const TriangleMesh& mesh) {
  double volume = 0.0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    volume += CornerOf(mesh, i).dot(CornerOf(mesh, i + 1).cross(CornerOf(mesh, i + 2))) / 6.0;
  }
  return volume;
}

Vector3d AreaVector(const TriangleMesh& mesh, size_t first) {
  return 0.5 * (CornerOf(mesh, first + 1) - CornerOf(mesh, first))
                   .cross(CornerOf(mesh, first + 2) - CornerOf(mesh, first));
}

double Area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    area += AreaVector(mesh, i).norm();
  }
  return area;
}

Eigen::AlignedBox3d BoundsOf(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const glm::vec3& at : mesh.positions) {
    box.extend(geometry::ToEigen(at));
  }
  return box;
}

// Each edge is used once in each direction, no corner is duplicated, and every triangle has an
// area.
void ExpectClosed(const TriangleMesh& mesh) {
  ASSERT_TRUE(mesh.Validate("shape").ok());
  std::map<std::pair<uint32_t, uint32_t>, int> runs;
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    EXPECT_GT(AreaVector(mesh, i).norm(), 1e-8) << i / 3;
    for (size_t k = 0; k < 3; ++k) {
      ++runs[{mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]}];
    }
  }
  for (const auto& [edge, count] : runs) {
    EXPECT_EQ(count, 1) << edge.first << " to " << edge.second;
    EXPECT_EQ(runs.count({edge.second, edge.first}), 1u) << edge.first << " to " << edge.second;
  }
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      EXPECT_NE(mesh.positions[i], mesh.positions[j]);
    }
  }
}

// A small step outwards from the centre of each triangle is outside the solid, a step inwards is
// inside.
template <typename Inside>
void ExpectOutward(const TriangleMesh& mesh, const Inside& inside) {
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vector3d middle =
        (CornerOf(mesh, i) + CornerOf(mesh, i + 1) + CornerOf(mesh, i + 2)) / 3.0;
    const Vector3d step = 2e-4 * AreaVector(mesh, i).normalized();
    EXPECT_FALSE(inside(middle + step)) << i / 3 << ": " << (middle + step).transpose();
    EXPECT_TRUE(inside(middle - step)) << i / 3 << ": " << (middle - step).transpose();
  }
}

TEST(OccluderShape, ABoxHasItsSizesAndFacesOutwards) {
  const TriangleMesh mesh = MakeShapeMesh({Kind::kBox, 2.0, 0.9, 0.6});
  ExpectClosed(mesh);
  EXPECT_EQ(mesh.positions.size(), 8u);
  EXPECT_NEAR(Volume(mesh), 2.0 * 0.9 * 0.6, 1e-6);
  EXPECT_NEAR(Area(mesh), 2.0 * (2.0 * 0.9 + 0.9 * 0.6 + 0.6 * 2.0), 1e-6);
  EXPECT_TRUE(BoundsOf(mesh).isApprox(
      Eigen::AlignedBox3d(Vector3d(-1.0, 0.0, -0.3), Vector3d(1.0, 0.9, 0.3)), 1e-6));
  ExpectOutward(mesh, [](const Vector3d& p) {
    return std::abs(p.x()) < 1.0 && p.y() > 0.0 && p.y() < 0.9 && std::abs(p.z()) < 0.3;
  });
}

TEST(OccluderShape, APlaneIsASheetOfTwoSides) {
  const TriangleMesh mesh = MakeShapeMesh({Kind::kPlane, 3.0, 2.0});
  ExpectClosed(mesh);
  EXPECT_NEAR(Volume(mesh), 0.0, 1e-9);
  EXPECT_NEAR(Area(mesh), 2.0 * 3.0 * 2.0, 1e-6);
  EXPECT_TRUE(BoundsOf(mesh).isApprox(
      Eigen::AlignedBox3d(Vector3d(-1.5, 0.0, 0.0), Vector3d(1.5, 2.0, 0.0)), 1e-6));
  EXPECT_GT(AreaVector(mesh, 0).z(), 0.0);
  EXPECT_LT(AreaVector(mesh, 6).z(), 0.0);
}

TEST(OccluderShape, AFloorLiesAndItsUpperSideComesFirst) {
  const TriangleMesh mesh = MakeShapeMesh({.kind = Kind::kFloor, .width = 3.0, .depth = 2.0});
  ExpectClosed(mesh);
  EXPECT_NEAR(Volume(mesh), 0.0, 1e-9);
  EXPECT_NEAR(Area(mesh), 2.0 * 3.0 * 2.0, 1e-6);
  EXPECT_TRUE(BoundsOf(mesh).isApprox(
      Eigen::AlignedBox3d(Vector3d(-1.5, 0.0, -1.0), Vector3d(1.5, 0.0, 1.0)), 1e-6));
  EXPECT_GT(AreaVector(mesh, 0).y(), 0.0);
  EXPECT_LT(AreaVector(mesh, 6).y(), 0.0);
}

TEST(OccluderShape, ACylinderIsAPrismWithinItsCircle) {
  const TriangleMesh mesh = MakeShapeMesh({Kind::kCylinder, 0.8, 2.5});
  ExpectClosed(mesh);
  const double radius = 0.4;
  EXPECT_NEAR(Volume(mesh), kPolygonArea * radius * radius * 2.5, 1e-6);
  EXPECT_NEAR(Volume(mesh), kPi * radius * radius * 2.5, 0.003 * kPi * radius * radius * 2.5);
  EXPECT_NEAR(Area(mesh), 2.0 * kPolygonArea * radius * radius + kPolygonLength * radius * 2.5,
              1e-5);
  EXPECT_TRUE(BoundsOf(mesh).isApprox(
      Eigen::AlignedBox3d(Vector3d(-0.4, 0.0, -0.4), Vector3d(0.4, 2.5, 0.4)), 1e-6));
  const double within = radius * std::cos(kPi / kRoundSides);
  ExpectOutward(mesh, [&](const Vector3d& p) {
    const double angle =
        std::remainder(std::atan2(p.z(), p.x()) - kPi / kRoundSides, 2.0 * kPi / kRoundSides);
    return std::hypot(p.x(), p.z()) * std::cos(angle) < within && p.y() > 0.0 && p.y() < 2.5;
  });
}

TEST(OccluderShape, AnArchIsAWallLessItsOpening) {
  for (const double spring : {1.8, 0.0}) {
    SCOPED_TRACE(spring);
    const OccluderShape arch = {Kind::kArch, 3.0, 3.0, 0.4, 1.2, spring};
    ASSERT_TRUE(CheckShape(arch, "arch").ok());
    const TriangleMesh mesh = MakeShapeMesh(arch);
    ExpectClosed(mesh);
    const double radius = 0.6;
    const double face = 3.0 * 3.0 - 1.2 * spring - 0.5 * kPolygonArea * radius * radius;
    EXPECT_NEAR(Volume(mesh), face * 0.4, 1e-5);
    // The side faces: the outer sides and the top, the rest of the base, and the intrados.
    const double round = 3.0 * 3.0 + (3.0 - 1.2) + 2.0 * spring + 0.5 * kPolygonLength * radius;
    EXPECT_NEAR(Area(mesh), 2.0 * face + round * 0.4, 1e-5);
    EXPECT_TRUE(BoundsOf(mesh).isApprox(
        Eigen::AlignedBox3d(Vector3d(-1.5, 0.0, -0.2), Vector3d(1.5, 3.0, 0.2)), 1e-6));
    const double within = radius * std::cos(kPi / kRoundSides);
    ExpectOutward(mesh, [&](const Vector3d& p) {
      const Vector3d from = p - Vector3d(0.0, spring, 0.0);
      const double angle = std::remainder(std::atan2(from.y(), from.x()) - kPi / kRoundSides,
                                          2.0 * kPi / kRoundSides);
      const bool open = p.y() < spring ? std::abs(p.x()) < radius
                                       : std::hypot(from.x(), from.y()) * std::cos(angle) < within;
      return std::abs(p.x()) < 1.5 && p.y() > 0.0 && p.y() < 3.0 && std::abs(p.z()) < 0.2 && !open;
    });
  }
}

TEST(OccluderShape, OneLooksThroughAnArchButNotThroughItsWall) {
  const vision::OccluderTree tree(
      vision::Placed(MakeShapeMesh(EntryOf(Kind::kArch).usual), geometry::Similarity3()));
  const auto hits = [&](double x, double y) {
    const Eigen::Vector3f eye(static_cast<float>(x), static_cast<float>(y), 5.0f);
    return tree.FirstHit(eye, -Eigen::Vector3f::UnitZ(), 0.0f, 10.0f).has_value();
  };
  EXPECT_FALSE(hits(0.0, 0.1));
  EXPECT_FALSE(hits(0.55, 1.7));
  EXPECT_FALSE(hits(0.0, 2.35));
  EXPECT_TRUE(hits(0.0, 2.45));
  EXPECT_TRUE(hits(0.5, 2.3));  // A point of the spandrel.
  EXPECT_TRUE(hits(0.7, 0.1));
  EXPECT_TRUE(hits(-1.4, 2.9));
}

TEST(OccluderShape, SizesBeyondTheirLimitsAreRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const ShapeEntry& entry : ShapeEntries()) {
    EXPECT_TRUE(CheckShape(entry.usual, "it").ok()) << entry.name;
    EXPECT_EQ(entry.name, EntryOf(entry.usual.kind).name);
    EXPECT_EQ(FindShapeEntry(entry.name), &entry);
    for (const ShapeSize& size : entry.sizes) {
      for (const double wrong : {-1.0, 0.0, 0.0009, 1000.1, 1e300, nan}) {
        OccluderShape shape = entry.usual;
        shape.*size.value = wrong;
        const bool floor = wrong >= 0.0 && wrong < 1.0 && size.value == &OccluderShape::spring;
        EXPECT_EQ(CheckShape(shape, "it").ok(), floor) << entry.name << " " << size.name << wrong;
        if (!floor) {
          EXPECT_THAT(CheckShape(shape, "it").message(), HasSubstr(size.name)) << entry.name;
        }
      }
    }
  }
  EXPECT_EQ(FindShapeEntry("cone"), nullptr);
}

TEST(OccluderShape, AnArchNeedsAWallAroundItsOpening) {
  EXPECT_THAT(CheckShape({Kind::kArch, 1.2, 3.0, 0.3, 1.2, 1.8}, "gate").message(),
              HasSubstr("gate: an opening of 1.2 m leaves no wall of 1.2 m beside it"));
  EXPECT_THAT(CheckShape({Kind::kArch, 3.0, 2.4, 0.3, 1.2, 1.8}, "gate").message(),
              HasSubstr("ends 2.4 m above the floor"));
}

TEST(OccluderShape, TheEndsOfARangeAreAllowedAndMakeASolid) {
  for (const ShapeEntry& entry : ShapeEntries()) {
    for (const ShapeSize& size : entry.sizes) {
      const auto [least, most] = RangeOf(entry.usual, size);
      for (const double end : {least, most}) {
        OccluderShape shape = entry.usual;
        shape.*size.value = end;
        EXPECT_TRUE(CheckShape(shape, "it").ok()) << entry.name << " " << size.name << " " << end;
        EXPECT_GE(Volume(MakeShapeMesh(shape)), 0.0);
        shape.*size.value = end + (end == least ? -2e-3 : 2e-3);
        EXPECT_FALSE(CheckShape(shape, "it").ok()) << entry.name << " " << size.name << " " << end;
      }
    }
  }
}

TEST(OccluderShape, IsWrittenWithTheSizesOfItsKindAlone) {
  for (const ShapeEntry& entry : ShapeEntries()) {
    OccluderShape shape = entry.usual;
    shape.height = 4.25;
    const Json json = FormatFields(shape);
    EXPECT_EQ(json.size(), entry.sizes.size() + 1);
    const auto read = ParseFields<OccluderShape>(JsonView(json, "shape"));
    ASSERT_TRUE(read.ok()) << read.message();
    EXPECT_EQ(read->kind, shape.kind);
    for (const ShapeSize& size : entry.sizes) {
      EXPECT_EQ((*read).*size.value, shape.*size.value) << entry.name << " " << size.name;
      Json without = json;
      without.erase(size.name);
      EXPECT_THAT(ParseFields<OccluderShape>(JsonView(without, "shape")).message(),
                  HasSubstr(size.name));
    }
    Json more = json;
    more["girth"] = 1.0;
    EXPECT_THAT(ParseFields<OccluderShape>(JsonView(more, "shape")).message(), HasSubstr("girth"));
  }
  const Json cone = {{"kind", "cone"}, {"height", 1}};
  EXPECT_THAT(ParseFields<OccluderShape>(JsonView(cone, "shape")).message(), HasSubstr("use box"));
}

TEST(FloorBefore, IsWhereTheCameraLooksButNeitherTooNearNorTooFar) {
  // A camera at a height of 1.6 m that looks along the stage's -z, tilted down. down: radians.
  const auto looking = [](double down) {
    geometry::Rigid3 stage_from_camera;
    stage_from_camera.rotation =
        Eigen::AngleAxisd(-down, Vector3d::UnitX()) * Eigen::AngleAxisd(kPi, Vector3d::UnitX());
    stage_from_camera.translation = {0.5, 1.6, 2.0};
    return std::optional(stage_from_camera.Inverse());
  };
  EXPECT_EQ(FloorBefore(std::nullopt), Vector3d::Zero());
  EXPECT_LT((FloorBefore(looking(0.5)) - Vector3d(0.5, 0.0, 2.0 - 1.6 / std::tan(0.5))).norm(),
            0.01);
  EXPECT_LT((FloorBefore(looking(1.5)) - Vector3d(0.5, 0.0, 1.0)).norm(), 0.01);
  EXPECT_LT((FloorBefore(looking(0.05)) - Vector3d(0.5, 0.0, -4.0)).norm(), 0.01);
  EXPECT_LT((FloorBefore(looking(-0.3)) - Vector3d(0.5, 0.0, -1.0)).norm(), 0.01);
  EXPECT_LT((FloorBefore(looking(kPi / 2.0)) - Vector3d(0.5, 0.0, 2.0)).norm(), 0.01);
}

}  // namespace
}  // namespace lararium::editor
