#include "editor/import/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace lararium::import {
namespace {

constexpr float kShares[kLevelsOfDetail] = {0.5f, 0.25f, 0.125f, 0.0625f};
constexpr float kMostOfThePrevious = 0.85f;  // a level must be smaller than this of it
constexpr float kMostError = 0.15f;          // of the mesh's extent
constexpr size_t kLeastTriangles = 32;

}  // namespace

void OrderForCache(size_t vertex_count, std::vector<uint32_t>& indices) {
  if (indices.empty()) {
    return;
  }
  std::vector<uint32_t> ordered(indices.size());
  meshopt_optimizeVertexCache(ordered.data(), indices.data(), indices.size(), vertex_count);
  indices = std::move(ordered);
}

std::vector<human::LevelOfDetail> CoarserLevels(std::span<const glm::vec3> positions,
                                                std::span<const uint32_t> indices,
                                                size_t whole) {
  std::vector<human::LevelOfDetail> levels;
  if (indices.empty()) {
    return levels;
  }
  const float* first = &positions[0].x;
  const float extent = meshopt_simplifyScale(first, positions.size(), sizeof(glm::vec3));
  size_t previous = whole;
  for (const float share : kShares) {
    const size_t wanted =
        std::min(static_cast<size_t>(share * static_cast<float>(whole)) / 3 * 3, indices.size());
    if (wanted < 3 * kLeastTriangles) {
      break;
    }
    human::LevelOfDetail level;
    level.indices.resize(indices.size());
    float error = 0.0f;
    const size_t left =
        meshopt_simplify(level.indices.data(), indices.data(), indices.size(), first,
                         positions.size(), sizeof(glm::vec3), wanted, kMostError, 0, &error);
    if (left == 0 || static_cast<float>(left) > kMostOfThePrevious * static_cast<float>(previous)) {
      continue;
    }
    level.indices.resize(left);
    level.error = error * extent;
    OrderForCache(positions.size(), level.indices);
    previous = left;
    levels.push_back(std::move(level));
  }
  return levels;
}

float MeanEdge(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) {
  double sum = 0.0;
  for (size_t i = 0; i < indices.size(); ++i) {
    const size_t next = i % 3 == 2 ? i - 2 : i + 1;
    sum += double{glm::distance(positions[indices[i]], positions[indices[next]])};
  }
  return indices.empty() ? 0.0f : static_cast<float>(sum / static_cast<double>(indices.size()));
}

}  // namespace lararium::import
