#include "editor/bake/refine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "tests/bake/test_surfaces.h"
#include "tests/bake/test_things.h"

namespace lararium::bake {
namespace {

using PlaceLevel = std::tuple<float, float, float>;

PlaceLevel PlaceOf(const glm::vec3& p) { return {p.x, p.y, p.z}; }

float LongestEdge(const stage::PropMesh& mesh) {
  float longest = 0.0f;
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const uint32_t next = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
    longest =
        std::max(longest, glm::distance(mesh.positions[mesh.indices[i]], mesh.positions[next]));
  }
  return longest;
}

float AreaOf(const stage::PropMesh& mesh) {
  float area = 0.0f;
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::vec3& a = mesh.positions[mesh.indices[t]];
    area += 0.5f * glm::length(glm::cross(mesh.positions[mesh.indices[t + 1]] - a,
                                          mesh.positions[mesh.indices[t + 2]] - a));
  }
  return area;
}

TEST(Refine, LeavesNoLongEdgeAndTheSameClosedSurface) {
  stage::PropMesh mesh = ToPropMesh(MakeBox({0, 0, 0}, {1.0f, 0.3f, 0.05f}, glm::vec3(0.5f)));
  mesh.uvs.assign(mesh.positions.size(), glm::vec2(0.0f));
  const float area = AreaOf(mesh);
  RefineMesh(0.1f, 10'000, mesh);
  EXPECT_LE(LongestEdge(mesh), 0.1f);
  EXPECT_NEAR(AreaOf(mesh), area, 1e-4f);
  EXPECT_TRUE(mesh.Validate(0, "here").ok()) << mesh.Validate(0, "here").message();
  // Watertight: each edge, identified by its positions, is used equally often in both
  // directions.
  std::map<std::pair<PlaceLevel, PlaceLevel>, int> edges;
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const uint32_t next = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
    const PlaceLevel a = PlaceOf(mesh.positions[mesh.indices[i]]);
    const PlaceLevel b = PlaceOf(mesh.positions[next]);
    edges[std::minmax(a, b)] += a < b ? 1 : -1;
  }
  for (const auto& [edge, balance] : edges) {
    EXPECT_EQ(balance, 0);
  }
}

TEST(Refine, InterpolatesWhatVerticesHave) {
  stage::PropMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  for (const glm::vec3& position : mesh.positions) {
    mesh.albedo.push_back(0.5f * position);
    mesh.uvs.emplace_back(position.x, 1.0f - position.y);
  }
  mesh.indices = {0, 1, 2};
  RefineMesh(0.2f, 1000, mesh);
  ASSERT_GT(mesh.positions.size(), 20u);
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_LT(glm::distance(mesh.albedo[v], 0.5f * mesh.positions[v]), 1e-5f);
    EXPECT_LT(glm::distance(mesh.uvs[v], {mesh.positions[v].x, 1.0f - mesh.positions[v].y}), 1e-5f);
    EXPECT_LT(glm::distance(mesh.normals[v], {0, 0, 1}), 1e-5f);
  }
}

TEST(Refine, LeavesAMeshThatWouldGrowTooLargeAsItIs) {
  stage::PropMesh mesh = ToPropMesh(MakeBox({0, 0, 0}, {9, 9, 9}, glm::vec3(0.5f)));
  const size_t before = mesh.positions.size();
  RefineMesh(0.1f, 500, mesh);
  EXPECT_EQ(mesh.positions.size(), before);
  EXPECT_EQ(mesh.indices.size(), 36u);
}

}  // namespace
}  // namespace lararium::bake
