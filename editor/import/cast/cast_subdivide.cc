#include "editor/import/cast/cast_subdivide.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "editor/import/cast/cast_rig.h"

namespace lararium::import {
namespace {

using EdgeKey = std::pair<uint32_t, uint32_t>;

EdgeKey KeyOf(uint32_t a, uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

// An edge between two sources.
struct Edge {
  std::array<uint32_t, 2> opposite{};  // Sources opposite to the edge in its first two triangles.
  int triangles = 0;
  uint32_t middle = 0;  // The new source at its middle.

  bool open() const { return triangles != 2; }
};

// The three base vertices with the largest influence on the middle between two vertices.
void MiddleOnBase(const CastPiece& piece,
                  uint32_t a,
                  uint32_t b,
                  std::array<uint32_t, 3>& base,
                  glm::vec3& weights) {
  std::map<uint32_t, float> shares;
  for (const uint32_t v : {a, b}) {
    for (int k = 0; k < 3; ++k) {
      shares[piece.base[v][k]] += 0.5f * piece.base_weights[v][k];
    }
  }
  std::vector<std::pair<uint32_t, float>> sorted(shares.begin(), shares.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& x, const auto& y) {
    return std::abs(x.second) > std::abs(y.second);
  });
  sorted.resize(3, sorted.front().second != 0.0f ? std::pair(sorted.front().first, 0.0f)
                                                 : std::pair(piece.base[a][0], 0.0f));
  float sum = 0.0f;
  for (const auto& [unused, share] : sorted) {
    sum += share;
  }
  if (std::abs(sum) < 1e-3f) {
    base = piece.base[a];
    weights = piece.base_weights[a];
    return;
  }
  for (int k = 0; k < 3; ++k) {
    base[k] = sorted[k].first;
    weights[k] = sorted[k].second / sum;
  }
}

class LoopSubdivision {
 public:
  explicit LoopSubdivision(CastPiece& piece) : piece_(piece), mesh_(piece.mesh) {}

  void Run(const std::vector<bool>& chosen) {
    CollectEdges(chosen);
    MoveOldSources();
    PlaceNewSources();
    std::vector<uint32_t> indices;
    for (size_t t = 0; 3 * t + 2 < mesh_.indices.size(); ++t) {
      const std::array<uint32_t, 3> corners = {mesh_.indices[3 * t], mesh_.indices[3 * t + 1],
                                               mesh_.indices[3 * t + 2]};
      if (t < chosen.size() && chosen[t]) {
        AddFour(corners, indices);
      } else {
        indices.insert(indices.end(), corners.begin(), corners.end());
      }
    }
    mesh_.indices = std::move(indices);
    for (size_t v = 0; v < mesh_.positions.size(); ++v) {
      mesh_.positions[v] = places_[piece_.source[v]];
    }
    mesh_.normals.resize(mesh_.positions.size(), glm::vec3(0.0f, 1.0f, 0.0f));
  }

 private:
  void CollectEdges(const std::vector<bool>& chosen) {
    const auto sources = std::max_element(piece_.source.begin(), piece_.source.end());
    places_.resize(sources == piece_.source.end() ? 0 : *sources + 1, glm::vec3(0.0f));
    for (size_t v = 0; v < piece_.source.size(); ++v) {
      places_[piece_.source[v]] = mesh_.positions[v];
    }
    for (size_t t = 0; t < chosen.size() && 3 * t + 2 < mesh_.indices.size(); ++t) {
      for (int k = 0; chosen[t] && k < 3; ++k) {
        const auto source = [&](int corner) {
          return piece_.source[mesh_.indices[3 * t + static_cast<size_t>(corner % 3)]];
        };
        Edge& edge = edges_[KeyOf(source(k), source(k + 1))];
        if (edge.triangles < 2) {
          edge.opposite[static_cast<size_t>(edge.triangles)] = source(k + 2);
        }
        ++edge.triangles;
      }
    }
  }

  void MoveOldSources() {
    struct Ring {
      glm::vec3 sum{0.0f};
      int count = 0;
      glm::vec3 open_sum{0.0f};
      int open_count = 0;
    };
    std::map<uint32_t, Ring> rings;
    for (const auto& [key, edge] : edges_) {
      for (const auto& [here, there] : {key, EdgeKey(key.second, key.first)}) {
        Ring& ring = rings[here];
        ring.sum += places_[there];
        ++ring.count;
        if (edge.open()) {
          ring.open_sum += places_[there];
          ++ring.open_count;
        }
      }
    }
    old_ = places_;
    for (const auto& [source, ring] : rings) {
      const glm::vec3& before = old_[source];
      if (ring.open_count == 2) {
        places_[source] = 0.75f * before + 0.125f * ring.open_sum;
      } else if (ring.open_count == 0) {
        const auto n = static_cast<float>(ring.count);
        const float share = ring.count == 3 ? 3.0f / 16.0f : 3.0f / (8.0f * n);
        places_[source] = (1.0f - n * share) * before + share * ring.sum;
      }
    }
  }

  void PlaceNewSources() {
    for (auto& [key, edge] : edges_) {
      edge.middle = static_cast<uint32_t>(places_.size());
      const glm::vec3 ends = old_[key.first] + old_[key.second];
      places_.push_back(
          edge.open() ? 0.5f * ends
                      : 0.375f * ends + 0.125f * (old_[edge.opposite[0]] + old_[edge.opposite[1]]));
    }
  }

  void AddFour(const std::array<uint32_t, 3>& c, std::vector<uint32_t>& indices) {
    const uint32_t ab = Middle(c[0], c[1]);
    const uint32_t bc = Middle(c[1], c[2]);
    const uint32_t ca = Middle(c[2], c[0]);
    indices.insert(indices.end(), {c[0], ab, ca, ab, c[1], bc, ca, bc, c[2], ab, bc, ca});
  }

  uint32_t Middle(uint32_t a, uint32_t b) {
    const auto [found, added] =
        middles_.try_emplace(KeyOf(a, b), static_cast<uint32_t>(piece_.source.size()));
    if (!added) {
      return found->second;
    }
    piece_.source.push_back(edges_[KeyOf(piece_.source[a], piece_.source[b])].middle);
    mesh_.positions.emplace_back();
    mesh_.albedo.push_back(0.5f * (mesh_.albedo[a] + mesh_.albedo[b]));
    if (!mesh_.uvs.empty()) {
      mesh_.uvs.push_back(0.5f * (mesh_.uvs[a] + mesh_.uvs[b]));
    }
    std::array<uint32_t, 3> base{};
    glm::vec3 weights(0.0f);
    MiddleOnBase(piece_, a, b, base, weights);
    piece_.base.push_back(base);
    piece_.base_weights.push_back(weights);
    std::vector<std::pair<uint8_t, float>> influences;
    for (const uint32_t v : {a, b}) {
      for (int k = 0; k < 4; ++k) {
        influences.emplace_back(mesh_.joints[v][static_cast<size_t>(k)],
                                0.5f * mesh_.weights[v][k]);
      }
    }
    const Influences strongest = Strongest(influences);
    mesh_.joints.push_back(strongest.joints);
    mesh_.weights.push_back(strongest.weights);
    return found->second;
  }

  CastPiece& piece_;
  human::SkinnedMesh& mesh_;
  std::map<EdgeKey, Edge> edges_;        // Keys are sources.
  std::map<EdgeKey, uint32_t> middles_;  // Keys are vertices.
  std::vector<glm::vec3> places_;        // Indexed by source.
  std::vector<glm::vec3> old_;
};

}  // namespace

void SubdivideLoop(CastPiece& piece, const std::vector<bool>& chosen) {
  LoopSubdivision(piece).Run(chosen);
}

std::vector<uint32_t> ConnectedSurfaces(const CastPiece& piece) {
  const auto most = std::max_element(piece.source.begin(), piece.source.end());
  std::vector<uint32_t> leader(most == piece.source.end() ? 0 : *most + 1);
  std::iota(leader.begin(), leader.end(), 0u);
  const auto find = [&leader](uint32_t s) {
    while (leader[s] != s) {
      s = leader[s] = leader[leader[s]];
    }
    return s;
  };
  const std::vector<uint32_t>& indices = piece.mesh.indices;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    for (const size_t k : {i + 1, i + 2}) {
      leader[find(piece.source[indices[k]])] = find(piece.source[indices[i]]);
    }
  }
  std::map<uint32_t, uint32_t> numbers;
  std::vector<uint32_t> surfaces;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const uint32_t next = static_cast<uint32_t>(numbers.size());
    surfaces.push_back(numbers.try_emplace(find(piece.source[indices[i]]), next).first->second);
  }
  return surfaces;
}

void SmoothSurfaces(CastPiece& piece, const SmoothingLimits& limits) {
  struct Surface {
    double edges = 0.0;  // Sum in metres.
    size_t triangles = 0;
  };
  for (int level = 0; level < limits.levels; ++level) {
    const std::vector<uint32_t> surface_of = ConnectedSurfaces(piece);
    std::vector<Surface> surfaces;
    for (size_t t = 0; t < surface_of.size(); ++t) {
      surfaces.resize(std::max<size_t>(surfaces.size(), surface_of[t] + 1));
      Surface& surface = surfaces[surface_of[t]];
      ++surface.triangles;
      for (size_t k = 0; k < 3; ++k) {
        surface.edges += static_cast<double>(
            glm::distance(piece.mesh.positions[piece.mesh.indices[3 * t + k]],
                          piece.mesh.positions[piece.mesh.indices[3 * t + (k + 1) % 3]]));
      }
    }
    std::vector<bool> chosen;
    for (const uint32_t s : surface_of) {
      const double mean = surfaces[s].edges / (3.0 * static_cast<double>(surfaces[s].triangles));
      chosen.push_back(mean > static_cast<double>(limits.edge));
    }
    const auto count = static_cast<size_t>(std::count(chosen.begin(), chosen.end(), true));
    if (count == 0 || surface_of.size() + 3 * count > limits.triangles) {
      return;
    }
    SubdivideLoop(piece, chosen);
  }
}

}  // namespace lararium::import
