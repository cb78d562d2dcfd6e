#include "shared/geometry/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace lararium::geometry {
namespace {

TriangleMesh Tetrahedron() {
  TriangleMesh mesh;
  mesh.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.indices = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
  return mesh;
}

TEST(ComputeNormals, PointOutwardsOnARegularTetrahedron) {
  TriangleMesh mesh = Tetrahedron();
  ComputeNormals(mesh);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    EXPECT_NEAR(glm::dot(mesh.normals[i], glm::normalize(mesh.positions[i])), 1.0f, 1e-5f);
  }
}

TEST(ComputeNormals, SurvivesDegenerateTriangles) {
  TriangleMesh mesh = Tetrahedron();
  mesh.indices.insert(mesh.indices.end(), {0, 0, 1});
  mesh.positions.push_back({5, 5, 5});  // used by no triangle
  ComputeNormals(mesh);
  EXPECT_TRUE(mesh.Validate("mesh").ok());
}

TEST(TriangleMesh, ValidateNamesTheFault) {
  TriangleMesh mesh = Tetrahedron();
  EXPECT_TRUE(mesh.Validate("mesh").ok());
  mesh.indices[3] = 4;
  EXPECT_NE(mesh.Validate("mesh").message().find("does not exist"), std::string::npos);
  mesh = Tetrahedron();
  mesh.positions[0].x = NAN;
  EXPECT_NE(mesh.Validate("mesh").message().find("finite"), std::string::npos);
  mesh = Tetrahedron();
  mesh.indices.pop_back();
  EXPECT_FALSE(mesh.Validate("mesh").ok());
}

}  // namespace
}  // namespace lararium::geometry
