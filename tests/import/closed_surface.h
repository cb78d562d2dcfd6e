#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>

namespace lararium::import {

// Counts the edges that do not join exactly two triangles, one in each direction.
inline size_t CountOpenEdges(std::span<const uint32_t> indices) {
  std::map<std::pair<uint32_t, uint32_t>, std::pair<int, int>> uses;
  for (size_t i = 0; i < indices.size(); ++i) {
    const uint32_t from = indices[i];
    const uint32_t to = indices[i % 3 == 2 ? i - 2 : i + 1];
    auto& use = uses[{std::min(from, to), std::max(from, to)}];
    ++(from < to ? use.first : use.second);
  }
  size_t open = 0;
  for (const auto& [edge, use] : uses) {
    open += use.first == 1 && use.second == 1 ? 0 : 1;
  }
  return open;
}

}  // namespace lararium::import
