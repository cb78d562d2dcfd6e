#include "editor/import/levels_of_detail.h"

#include <meshoptimizer.h>

#include <utility>

namespace lararium::import {
namespace {

constexpr float kShares[] = {0.5f, 0.25f, 0.125f};
constexpr float kMostOfThePrevious = 0.85f;  // a level must be smaller than this of it
constexpr float kMostError = 0.15f;          // of the mesh's extent
constexpr size_t kLeastTriangles = 32;

void OrderIndices(std::vector<uint32_t>& indices, size_t vertex_count) {
  std::vector<uint32_t> ordered(indices.size());
  meshopt_optimizeVertexCache(ordered.data(), indices.data(), indices.size(), vertex_count);
  indices = std::move(ordered);
}

}  // namespace

void OrderTriangles(human::SkinnedMesh& mesh) {
  if (!mesh.indices.empty()) {
    OrderIndices(mesh.indices, mesh.positions.size());
  }
}

void AddLevelsOfDetail(human::SkinnedMesh& mesh) {
  mesh.coarser.clear();
  if (mesh.indices.empty()) {
    return;
  }
  const float* positions = &mesh.positions[0].x;
  const size_t count = mesh.positions.size();
  const float extent = meshopt_simplifyScale(positions, count, sizeof(glm::vec3));
  size_t previous = mesh.indices.size();
  for (const float share : kShares) {
    const size_t wanted = static_cast<size_t>(share * mesh.indices.size()) / 3 * 3;
    if (wanted < 3 * kLeastTriangles) {
      return;
    }
    human::LevelOfDetail level;
    level.indices.resize(mesh.indices.size());
    float error = 0.0f;
    const size_t left =
        meshopt_simplify(level.indices.data(), mesh.indices.data(), mesh.indices.size(), positions,
                         count, sizeof(glm::vec3), wanted, kMostError, 0, &error);
    if (left == 0 || left > kMostOfThePrevious * previous) {
      continue;
    }
    level.indices.resize(left);
    level.error = error * extent;
    OrderIndices(level.indices, count);
    previous = left;
    mesh.coarser.push_back(std::move(level));
  }
}

}  // namespace lararium::import
