#include "editor/panels/viewport/overlay_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace lararium::panels {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using geometry::Similarity3;

// A cube with edges of length 2 around the origin. As in files, each face has its own copies of the
// corners.
geometry::TriangleMesh Cube() {
  geometry::TriangleMesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const auto first = static_cast<uint32_t>(mesh.positions.size());
      for (const auto& [u, v] :
           {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
        glm::vec3 corner;
        corner[axis] = side;
        corner[(axis + 1) % 3] = u;
        corner[(axis + 2) % 3] = v;
        mesh.positions.push_back(corner);
      }
      for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) {
        mesh.indices.push_back(first + i);
      }
    }
  }
  return mesh;
}

geometry::TriangleMesh Triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  return {{a, b, c}, {}, {0, 1, 2}};
}

// A camera at the origin that looks along +z.
ViewCamera AheadOfView() {
  ViewCamera view;
  view.focal_x = view.focal_y = 500.0;
  view.center = {400.0, 300.0};
  return view;
}

std::vector<OverlayFace> FacesOf(const geometry::TriangleMesh& mesh,
                                 const Vector3d& at = Vector3d::Zero()) {
  std::vector<OverlayFace> faces;
  AddFaces(MakeOverlayMesh(mesh), {1.0, Eigen::Quaterniond::Identity(), at}, AheadOfView(), 7,
           faces);
  return faces;
}

TEST(OverlayMesh, ACubeHasTheEdgesThatPeopleSeeAndNoDiagonals) {
  const OverlayMesh overlay = MakeOverlayMesh(Cube());
  EXPECT_EQ(overlay.corners.size(), 8u);
  EXPECT_EQ(overlay.faces.size(), 12u);
  ASSERT_EQ(overlay.edges.size(), 12u);
  for (const auto& [a, b] : overlay.edges) {
    EXPECT_DOUBLE_EQ((overlay.corners[a] - overlay.corners[b]).norm(), 2.0);
  }
}

TEST(OverlayMesh, AFlatFaceIsEdgedWhereItEnds) {
  const geometry::TriangleMesh square{
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {}, {0, 1, 2, 2, 0, 3}};
  // The winding of the triangles does not matter.
  EXPECT_EQ(MakeOverlayMesh(square).edges.size(), 4u);
}

TEST(OverlayMesh, TrianglesWithoutAreaAreLeftOut) {
  EXPECT_TRUE(MakeOverlayMesh(Triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2})).faces.empty());
  EXPECT_TRUE(MakeOverlayMesh(Triangle({0, 0, 0}, {1, 1, 1}, {0, 0, 0})).edges.empty());
}

TEST(OverlayMesh, FacesLieWhereTheCameraSeesThem) {
  const std::vector<OverlayFace> faces = FacesOf(Triangle({0, 0, 5}, {1, 0, 5}, {0, 1, 5}));
  ASSERT_EQ(faces.size(), 1u);
  ASSERT_EQ(faces[0].corners, 3);
  EXPECT_TRUE(faces[0].outline[0].isApprox(Vector2d(400.0, 300.0)));
  EXPECT_TRUE(faces[0].outline[1].isApprox(Vector2d(500.0, 300.0)));
  EXPECT_TRUE(faces[0].outline[2].isApprox(Vector2d(400.0, 400.0)));
  EXPECT_DOUBLE_EQ(faces[0].distance, 5.0);
  EXPECT_EQ(faces[0].overlay, 7);
}

TEST(OverlayMesh, WhatLiesBehindTheCameraIsCutOff) {
  EXPECT_TRUE(FacesOf(Triangle({0, 0, -5}, {1, 0, -5}, {0, 1, -5})).empty());
  // One corner behind the camera leaves a quadrilateral, two leave a triangle.
  const std::vector<OverlayFace> one = FacesOf(Triangle({0, 0, -1}, {1, 0, 3}, {0, 1, 3}));
  const std::vector<OverlayFace> two = FacesOf(Triangle({0, 0, -1}, {1, 0, -1}, {0, 1, 3}));
  ASSERT_EQ(one.size(), 1u);
  ASSERT_EQ(two.size(), 1u);
  EXPECT_EQ(one[0].corners, 4);
  EXPECT_EQ(two[0].corners, 3);
  for (const OverlayFace& face : {one[0], two[0]}) {
    for (int i = 0; i < face.corners; ++i) {
      EXPECT_TRUE(face.outline[static_cast<size_t>(i)].allFinite());
    }
  }
}

TEST(OverlayMesh, ASheetOfTwoSidesIsOutlined) {
  geometry::TriangleMesh sheet;
  sheet.positions = {{-1, 0, 0}, {1, 0, 0}, {1, 2, 0}, {-1, 2, 0}};
  sheet.indices = {0, 1, 2, 0, 2, 3, 1, 0, 3, 1, 3, 2};
  const std::vector<std::array<uint32_t, 2>> rim = {{0, 1}, {0, 3}, {1, 2}, {2, 3}};
  EXPECT_EQ(MakeOverlayMesh(sheet).edges, rim);
}

TEST(OverlayMesh, StandingWithinASolidShowsItsWallsAhead) {
  const std::vector<OverlayFace> faces = FacesOf(Cube());
  EXPECT_FALSE(faces.empty());
  for (const OverlayFace& face : faces) {
    EXPECT_GE(face.distance, kOverlayNear);
  }
}

TEST(OverlayMesh, TheShadeTellsFacesApartAndIsTheSameFromEitherSide) {
  const double top = FacesOf(Triangle({-1, 1, 4}, {1, 1, 4}, {0, 1, 6}))[0].shade;
  const double front = FacesOf(Triangle({-1, -1, 4}, {1, -1, 4}, {0, 1, 4}))[0].shade;
  const double turned = FacesOf(Triangle({1, -1, 4}, {-1, -1, 4}, {0, 1, 4}))[0].shade;
  const double right = FacesOf(Triangle({-1, -1, 4}, {-1, 1, 4}, {-1, 0, 6}))[0].shade;
  EXPECT_DOUBLE_EQ(front, turned);
  EXPECT_GT(top, front + 0.05);    // The lamp is above the camera.
  EXPECT_GT(front, right + 0.05);  // The lamp is to the left, so a face to the right is dark.
  for (const double shade : {top, front, right}) {
    EXPECT_GT(shade, 0.2);
    EXPECT_LE(shade, 1.0);
  }
}

TEST(OverlayMesh, FartherFacesComeFirst) {
  std::vector<OverlayFace> faces = FacesOf(Cube(), {0.2, 0.3, 6.0});
  SortFarthestFirst(faces);
  double before = std::numeric_limits<double>::infinity();
  for (const OverlayFace& face : faces) {
    EXPECT_LE(face.distance, before);
    before = face.distance;
  }
}

}  // namespace
}  // namespace lararium::panels
