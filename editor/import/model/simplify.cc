#include "editor/import/model/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace lararium::import {
namespace {

constexpr float kShares[kLevelsOfDetail] = {1.0f / 2,  1.0f / 4,  1.0f / 8,
                                            1.0f / 16, 1.0f / 32, 1.0f / 64};
// A level must be smaller than this share of the previous one.
constexpr float kMostOfThePrevious = 0.85f;
constexpr float kMostError = 0.15f;  // Share of the extent of the mesh.
constexpr size_t kLeastTriangles = 32;
// If edge collapses leave more than this multiple of the wanted triangles, they were stopped by
// separate pieces.
constexpr float kStopped = 1.4f;

struct Simplified {
  std::vector<uint32_t> indices;
  float error = 0.0f;  // metres
};

Simplified Collapsed(std::span<const glm::vec3> positions,
                     std::span<const uint32_t> indices,
                     size_t wanted) {
  const float* first = &positions[0].x;
  Simplified made{std::vector<uint32_t>(indices.size()), 0.0f};
  made.indices.resize(meshopt_simplify(made.indices.data(), indices.data(), indices.size(), first,
                                       positions.size(), sizeof(glm::vec3), wanted, kMostError, 0,
                                       &made.error));
  made.error *= meshopt_simplifyScale(first, positions.size(), sizeof(glm::vec3));
  return made;
}

// The reported error is smaller than the visible one: everything in one cell of the grid
// becomes one point, and an edge is about as long as a cell.
Simplified Clustered(std::span<const glm::vec3> positions,
                     std::span<const uint32_t> indices,
                     size_t wanted) {
  std::vector<uint32_t> made(indices.size());
  made.resize(meshopt_simplifySloppy(made.data(), indices.data(), indices.size(), &positions[0].x,
                                     positions.size(), sizeof(glm::vec3), wanted, kMostError,
                                     nullptr));
  const float error = 0.5f * MeanEdge(positions, made);
  return {std::move(made), error};
}

Simplified Simplify(std::span<const glm::vec3> positions,
                    std::span<const uint32_t> indices,
                    size_t wanted) {
  Simplified collapsed = Collapsed(positions, indices, wanted);
  if (static_cast<float>(collapsed.indices.size()) <= kStopped * static_cast<float>(wanted)) {
    return collapsed;
  }
  Simplified clustered = Clustered(positions, indices, wanted);
  const bool finer = clustered.indices.size() >= collapsed.indices.size();
  return clustered.indices.empty() || finer ? collapsed : clustered;
}

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
  size_t previous = whole;
  float error = 0.0f;
  for (const float share : kShares) {
    const size_t wanted =
        std::min(static_cast<size_t>(share * static_cast<float>(whole)) / 3 * 3, indices.size());
    if (wanted < 3 * kLeastTriangles) {
      break;
    }
    Simplified made = Simplify(positions, indices, wanted);
    if (made.indices.empty() || static_cast<float>(made.indices.size()) >
                                    kMostOfThePrevious * static_cast<float>(previous)) {
      continue;
    }
    previous = made.indices.size();
    OrderForCache(positions.size(), made.indices);
    error = std::max(error, made.error);
    human::LevelOfDetail level;
    level.error = error;
    level.indices = std::move(made.indices);
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
