#include "editor/import/wardrobe/sheet.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

namespace lararium::import {
namespace {

uint32_t Root(std::vector<uint32_t>& parent, uint32_t i) {
  while (parent[i] != i) {
    i = parent[i] = parent[parent[i]];
  }
  return i;
}

std::pair<uint32_t, uint32_t> Ordered(uint32_t a, uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

// The particles and vertices that divide the edges of a sheet in half.
class Midpoints {
 public:
  explicit Midpoints(Sheet& fine) : fine_(fine) {}

  // An edge on a seam has a vertex on each panel, which share one particle.
  uint32_t Between(uint32_t a, uint32_t b) {
    const auto [entry, is_new] = vertices_.try_emplace(Ordered(a, b), 0);
    if (is_new) {
      entry->second = static_cast<uint32_t>(fine_.flat.size());
      fine_.flat.push_back(0.5f * (fine_.flat[a] + fine_.flat[b]));
      fine_.panel.push_back(fine_.panel[a]);
      fine_.particle.push_back(ParticleBetween(fine_.particle[a], fine_.particle[b]));
    }
    return entry->second;
  }

  const std::vector<std::array<uint32_t, 2>>& parents() const { return parents_; }

 private:
  uint32_t ParticleBetween(uint32_t a, uint32_t b) {
    const auto [entry, is_new] = particles_.try_emplace(Ordered(a, b), 0);
    if (is_new) {
      entry->second = static_cast<uint32_t>(fine_.positions.size());
      fine_.positions.push_back(0.5f * (fine_.positions[a] + fine_.positions[b]));
      for (size_t j = 0; j < (fine_.weights.empty() ? 0 : fine_.joint_count); ++j) {
        fine_.weights.push_back(0.5f * (fine_.WeightsOf(a)[j] + fine_.WeightsOf(b)[j]));
      }
      parents_.push_back({a, b});
    }
    return entry->second;
  }

  Sheet& fine_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> vertices_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> particles_;
  std::vector<std::array<uint32_t, 2>> parents_;
};

}  // namespace

std::vector<Triangle> Sheet::ParticleTriangles() const {
  std::vector<Triangle> result;
  result.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    result.push_back(Particles(t));
  }
  return result;
}

uint32_t AddPanel(Sheet& sheet, const GridPanel& grid, uint8_t panel) {
  const uint32_t first = static_cast<uint32_t>(sheet.flat.size());
  for (size_t row = 0; row < grid.rows; ++row) {
    for (size_t column = 0; column < grid.columns; ++column) {
      sheet.flat.push_back(grid.flat(column, row));
      sheet.panel.push_back(panel);
      sheet.particle.push_back(static_cast<uint32_t>(sheet.positions.size()));
      sheet.positions.push_back(grid.place(column, row));
    }
  }
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    sheet.triangles.push_back(grid.mirrored ? Triangle{a, c, b} : Triangle{a, b, c});
  };
  const uint32_t columns = static_cast<uint32_t>(grid.columns);
  for (uint32_t row = 0; row + 1 < grid.rows; ++row) {
    for (uint32_t column = 0; column + 1 < columns; ++column) {
      const uint32_t a = first + row * columns + column;
      const uint32_t b = a + 1;
      const uint32_t c = a + columns;
      const uint32_t d = c + 1;
      if ((row + column) % 2 == 0) {
        add(a, c, b);
        add(b, c, d);
      } else {
        add(a, d, b);
        add(a, c, d);
      }
    }
  }
  return first;
}

void Sew(Sheet& sheet, std::span<const std::array<uint32_t, 2>> pairs) {
  std::vector<uint32_t> parent(sheet.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (const auto& [a, b] : pairs) {
    const uint32_t root_a = Root(parent, sheet.particle[a]);
    const uint32_t root_b = Root(parent, sheet.particle[b]);
    parent[std::max(root_a, root_b)] = std::min(root_a, root_b);
  }
  std::vector<uint32_t> id(parent.size(), 0);
  std::vector<glm::vec3> sums;
  std::vector<float> counts;
  for (uint32_t p = 0; p < parent.size(); ++p) {
    const uint32_t root = Root(parent, p);
    if (root == p) {
      id[p] = static_cast<uint32_t>(sums.size());
      sums.emplace_back(0.0f);
      counts.push_back(0.0f);
    }
    sums[id[root]] += sheet.positions[p];
    counts[id[root]] += 1.0f;
  }
  for (size_t i = 0; i < sums.size(); ++i) {
    sums[i] /= counts[i];
  }
  for (uint32_t& p : sheet.particle) {
    p = id[Root(parent, p)];
  }
  sheet.positions = std::move(sums);
}

Sheet Subdivided(const Sheet& sheet, std::vector<std::array<uint32_t, 2>>* parents) {
  Sheet fine = sheet;
  fine.triangles.clear();
  Midpoints midpoints(fine);
  for (const auto& [a, b, c] : sheet.triangles) {
    const uint32_t ab = midpoints.Between(a, b);
    const uint32_t bc = midpoints.Between(b, c);
    const uint32_t ca = midpoints.Between(c, a);
    fine.triangles.insert(fine.triangles.end(),
                          {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  if (parents != nullptr) {
    parents->clear();
    for (uint32_t p = 0; p < sheet.positions.size(); ++p) {
      parents->push_back({p, p});
    }
    parents->insert(parents->end(), midpoints.parents().begin(), midpoints.parents().end());
  }
  return fine;
}

void MarkBands(Sheet& sheet,
               const std::function<bool(uint8_t panel, const glm::vec2& middle)>& inside) {
  std::map<uint32_t, uint32_t> doubled;
  for (Triangle& t : sheet.triangles) {
    const glm::vec2 middle = (sheet.flat[t[0]] + sheet.flat[t[1]] + sheet.flat[t[2]]) / 3.0f;
    if (!inside(sheet.panel[t[0]], middle)) {
      continue;
    }
    for (uint32_t& v : t) {
      const auto [entry, is_new] = doubled.try_emplace(v, static_cast<uint32_t>(sheet.flat.size()));
      if (is_new) {
        sheet.flat.push_back(glm::vec2(sheet.flat[v]));
        sheet.panel.push_back(static_cast<uint8_t>(sheet.panel[v] | kBand));
        sheet.particle.push_back(uint32_t(sheet.particle[v]));
      }
      v = entry->second;
    }
  }
}

void DropUnusedVertices(Sheet& sheet) {
  constexpr uint32_t kUnused = 0xffffffffu;
  std::vector<uint32_t> renamed(sheet.flat.size(), kUnused);
  Sheet kept;
  for (Triangle& t : sheet.triangles) {
    for (uint32_t& v : t) {
      if (renamed[v] == kUnused) {
        renamed[v] = static_cast<uint32_t>(kept.flat.size());
        kept.flat.push_back(sheet.flat[v]);
        kept.panel.push_back(sheet.panel[v]);
        kept.particle.push_back(sheet.particle[v]);
      }
      v = renamed[v];
    }
  }
  sheet.flat = std::move(kept.flat);
  sheet.panel = std::move(kept.panel);
  sheet.particle = std::move(kept.particle);
}

std::vector<glm::vec3> Normals(std::span<const glm::vec3> positions,
                               std::span<const Triangle> triangles) {
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0f));
  for (const auto& [a, b, c] : triangles) {
    const glm::vec3 normal = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    normals[a] += normal;
    normals[b] += normal;
    normals[c] += normal;
  }
  for (glm::vec3& normal : normals) {
    const float length = glm::length(normal);
    normal = length > 1e-12f ? normal / length : glm::vec3(0.0f, 1.0f, 0.0f);
  }
  return normals;
}

std::vector<std::vector<uint32_t>> NeighboursOf(size_t count, std::span<const Triangle> triangles) {
  std::vector<std::vector<uint32_t>> neighbours(count);
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      neighbours[t[k]].push_back(t[(k + 1) % 3]);
      neighbours[t[(k + 1) % 3]].push_back(t[k]);
    }
  }
  for (std::vector<uint32_t>& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

std::vector<std::array<uint32_t, 2>> OpenEdges(std::span<const Triangle> triangles) {
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      ++uses[Ordered(t[k], t[(k + 1) % 3])];
    }
  }
  std::vector<std::array<uint32_t, 2>> open;
  for (const auto& [edge, count] : uses) {
    if (count == 1) {
      open.push_back({edge.first, edge.second});
    }
  }
  return open;
}

}  // namespace lararium::import
