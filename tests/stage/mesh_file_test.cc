#include "shared/stage/mesh_file.h"

#include <gtest/gtest.h>

#include <limits>

namespace lararium::stage {
namespace {

geometry::TriangleMesh Tetrahedron() {
  geometry::TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.indices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  geometry::ComputeNormals(mesh);
  return mesh;
}

TEST(MeshFile, RoundTrips) {
  const geometry::TriangleMesh mesh = Tetrahedron();
  const auto parsed = ParseMesh(SerializeMesh(mesh), "a.larmesh");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->positions, mesh.positions);
  EXPECT_EQ(parsed->normals, mesh.normals);
  EXPECT_EQ(parsed->indices, mesh.indices);
  EXPECT_EQ(SerializeMesh(*parsed), SerializeMesh(mesh));
}

TEST(MeshFile, AnEmptyMeshRoundTrips) {
  const auto parsed = ParseMesh(SerializeMesh({}), "a.larmesh");
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_TRUE(parsed->positions.empty());
}

TEST(MeshFile, ReadsBytesAtAnyAlignment) {
  std::vector<std::byte> bytes = SerializeMesh(Tetrahedron());
  bytes.insert(bytes.begin(), std::byte{0});
  EXPECT_TRUE(ParseMesh(std::span(bytes).subspan(1), "a.larmesh").ok());
}

TEST(MeshFile, RefusesEveryTruncation) {
  const std::vector<std::byte> bytes = SerializeMesh(Tetrahedron());
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(
        ParseMesh(std::vector(bytes.begin(), bytes.begin() + static_cast<long>(size)), "a.larmesh")
            .ok())
        << size;
  }
}

TEST(MeshFile, SurvivesEveryChangedByte) {
  const std::vector<std::byte> bytes = SerializeMesh(Tetrahedron());
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (const std::byte flip : {std::byte{1}, std::byte{0x80}, std::byte{0xff}}) {
      std::vector<std::byte> changed = bytes;
      changed[i] ^= flip;
      if (const auto parsed = ParseMesh(changed, "a.larmesh"); parsed.ok()) {
        EXPECT_TRUE(parsed->Validate("a.larmesh").ok());
      }
    }
  }
}

TEST(MeshFile, RefusesWhatIsNotAMesh) {
  geometry::TriangleMesh mesh = Tetrahedron();
  mesh.indices[3] = 4;
  EXPECT_FALSE(ParseMesh(SerializeMesh(mesh), "a.larmesh").ok());
  mesh = Tetrahedron();
  mesh.positions[0].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(ParseMesh(SerializeMesh(mesh), "a.larmesh").ok());
}

}  // namespace
}  // namespace lararium::stage
