#include "shared/render/passes/closed_surface.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

namespace lararium::render {
namespace {

bool PositionLess(const glm::vec3& a, const glm::vec3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

// Gives each vertex a number; vertices at the same position get the same number.
std::vector<uint32_t> Weld(std::span<const glm::vec3> positions) {
  std::vector<uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return PositionLess(positions[a], positions[b]); });
  std::vector<uint32_t> welded(positions.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    welded[order[i]] = same ? welded[order[i - 1]] : order[i];
  }
  return welded;
}

bool FacesOutwards(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) {
  double volume = 0.0;  // six times the volume
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    volume += glm::dot(positions[indices[i]],
                       glm::cross(positions[indices[i + 1]], positions[indices[i + 2]]));
  }
  return volume > 0.0;
}

}  // namespace

bool IsClosedSurface(std::span<const glm::vec3> positions, std::span<const uint32_t> indices) {
  const std::vector<uint32_t> welded = Weld(positions);
  std::vector<uint64_t> edges;
  std::vector<uint64_t> reversed;
  edges.reserve(indices.size());
  reversed.reserve(indices.size());
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    for (size_t k = 0; k < 3; ++k) {
      const uint64_t from = welded[indices[i + k]];
      const uint64_t to = welded[indices[i + (k + 1) % 3]];
      edges.push_back(from << 32 | to);
      reversed.push_back(to << 32 | from);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::sort(reversed.begin(), reversed.end());
  return edges == reversed && FacesOutwards(positions, indices);
}

}  // namespace lararium::render
