#include "editor/import/wardrobe/drape.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <unordered_map>
#include <utility>

namespace lararium::import {
namespace {

constexpr float kStep = 1.0f / 60.0f;  // seconds
constexpr int kIterations = 8;
constexpr float kFastest = 1.5f;  // m/s
constexpr int kStepsBetweenPairs = 4;

struct FlatEdge {
  std::array<uint32_t, 2> opposite = {0, 0};  // vertices
  std::array<uint32_t, 2> ends = {0, 0};      // vertices
  int triangles = 0;
  float length = 0.0f;
  bool across = false;  // Crosses the threads diagonally.
};

float Height(const Sheet& sheet, uint32_t apex, const std::array<uint32_t, 2>& ends) {
  const glm::vec2 edge = sheet.flat[ends[1]] - sheet.flat[ends[0]];
  const glm::vec2 arm = sheet.flat[apex] - sheet.flat[ends[0]];
  return std::abs(edge.x * arm.y - edge.y * arm.x) / std::max(glm::length(edge), 1e-9f);
}

// Hash key of a cell of a spatial grid.
uint64_t CellKey(int x, int y, int z) {
  return (uint64_t(uint32_t(x) & 0x1fffff) << 42) | (uint64_t(uint32_t(y) & 0x1fffff) << 21) |
         uint64_t(uint32_t(z) & 0x1fffff);
}

}  // namespace

bool IsAcrossThreads(const glm::vec2& line) {
  const glm::vec2 d = glm::abs(line);
  return std::min(d.x, d.y) > 0.3f * std::max(d.x, d.y);
}

Draper::Draper(Sheet& sheet, const DrapeMaterial& material, const Progress& progress)
    : sheet_(sheet), material_(material), progress_(progress) {
  std::map<std::pair<uint32_t, uint32_t>, FlatEdge> edges;
  for (const Triangle& t : sheet.triangles) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = t[k];
      const uint32_t b = t[(k + 1) % 3];
      const uint32_t pa = sheet.particle[a];
      const uint32_t pb = sheet.particle[b];
      if (pa == pb) {
        continue;
      }
      FlatEdge& edge = edges[{std::min(pa, pb), std::max(pa, pb)}];
      const glm::vec2 d = sheet.flat[b] - sheet.flat[a];
      edge.length = std::max(edge.length, glm::length(d));
      edge.across = IsAcrossThreads(d);
      if (edge.triangles < 2) {
        edge.opposite[edge.triangles] = t[(k + 2) % 3];
      }
      edge.ends = {a, b};
      ++edge.triangles;
    }
  }
  for (const auto& [ends, edge] : edges) {
    const float stretch = edge.across ? material.shear : material.stretch;
    const float squeeze = edge.across ? material.shear : material.squeeze;
    edges_.push_back({ends.first, ends.second, edge.length, stretch, squeeze});
    const uint32_t c = sheet.particle[edge.opposite[0]];
    const uint32_t d = sheet.particle[edge.opposite[1]];
    if (edge.triangles == 2 && c != d && material.bend > 0.0f) {
      // The length over a seam uses the flattened triangles: the heights of both over their
      // common edge.
      const bool one_panel = sheet.panel[edge.opposite[0]] == sheet.panel[edge.opposite[1]];
      const float length =
          one_panel ? glm::length(sheet.flat[edge.opposite[0]] - sheet.flat[edge.opposite[1]])
                    : Height(sheet, edge.opposite[0], edge.ends) + edge.length;
      bends_.push_back({c, d, length, 0.0f, material.bend});
    }
  }
  neighbours_ = NeighboursOf(sheet.positions.size(), sheet.ParticleTriangles());
  Rest();
}

void Draper::Rest() {
  before_ = sheet_.positions;
  velocity_.assign(sheet_.positions.size(), glm::vec3(0.0f));
  steps_ = 0;
}

void Draper::Tether(uint32_t particle, uint32_t anchor, float length) {
  if (particle != anchor) {
    tethers_.push_back({particle, anchor, length});
  }
}

void Draper::Gather(const std::vector<bool>& particles) {
  for (Edge& edge : edges_) {
    if (particles[edge.a] && particles[edge.b]) {
      edge.squeeze = 0.02f;
    }
  }
}

void Draper::TakeLengths(float factor) {
  for (std::vector<Edge>* list : {&edges_, &bends_}) {
    for (Edge& edge : *list) {
      edge.length = factor * glm::distance(sheet_.positions[edge.a], sheet_.positions[edge.b]);
    }
  }
}

void Draper::Run(int steps, const BodyField& body) {
  for (int i = 0; i < steps && !progress_.Cancelled(); ++i) {
    Step(body);
  }
}

void Draper::Step(const BodyField& body) {
  std::vector<glm::vec3>& x = sheet_.positions;
  before_ = x;
  for (size_t i = 0; i < x.size(); ++i) {
    velocity_[i] *= 1.0f - damping;
    velocity_[i].y -= gravity * kStep;
    const float speed = glm::length(velocity_[i]);
    if (speed > kFastest) {
      velocity_[i] *= kFastest / speed;
    }
    x[i] += kStep * velocity_[i];
  }
  if (material_.own_gap > 0.0f && steps_ % kStepsBetweenPairs == 0) {
    FindPairs();
  }
  for (int i = 0; i < kIterations; ++i) {
    MendEdges(i % 2 == 1);
    for (const DrapePin& pin : pins) {
      x[pin.particle] += pin.strength * (pin.place - x[pin.particle]);
    }
    if (rule) {
      rule(x);
    }
  }
  KeepApart();
  KeepOut(body);
  for (size_t i = 0; i < x.size(); ++i) {
    velocity_[i] = (x[i] - before_[i]) / kStep;
  }
  ++steps_;
}

void Draper::MendEdges(bool backward) {
  std::vector<glm::vec3>& x = sheet_.positions;
  const auto mend = [&x](const Edge& edge) {
    const glm::vec3 d = x[edge.b] - x[edge.a];
    const float length = std::sqrt(glm::dot(d, d)) + 1e-9f;
    const float error = length - edge.length;
    const float share = error > 0.0f ? edge.stretch : edge.squeeze;
    const glm::vec3 move = d * (0.5f * share * error / length);
    x[edge.a] += move;
    x[edge.b] -= move;
  };
  if (backward) {
    std::for_each(edges_.rbegin(), edges_.rend(), mend);
  } else {
    std::for_each(edges_.begin(), edges_.end(), mend);
  }
  std::for_each(bends_.begin(), bends_.end(), mend);
  for (const TetherLine& tether : tethers_) {
    const glm::vec3 d = x[tether.particle] - x[tether.anchor];
    const float length = glm::length(d);
    if (length > tether.length) {
      x[tether.particle] -= d * (1.0f - tether.length / length);
    }
  }
}

void Draper::KeepOut(const BodyField& body) {
  std::vector<glm::vec3>& x = sheet_.positions;
  for (size_t i = 0; i < x.size(); ++i) {
    if (floor) {
      x[i].y = std::max(x[i].y, 0.5f * material_.gap);
    }
    const FieldSample sample = body.Sample(x[i]);
    const float depth = material_.gap - sample.distance;
    if (depth <= 0.0f) {
      continue;
    }
    x[i] += sample.outward * depth;
    glm::vec3 slip = x[i] - before_[i];
    slip -= sample.outward * glm::dot(slip, sample.outward);
    const float length = glm::length(slip);
    if (length > 1e-9f) {
      x[i] -= slip * std::min(1.0f, material_.friction * depth / length);
    }
  }
}

void Draper::FindPairs() {
  const std::vector<glm::vec3>& x = sheet_.positions;
  const float cell = 2.0f * material_.own_gap;
  std::unordered_map<uint64_t, std::vector<uint32_t>> cells;
  cells.reserve(x.size());
  const auto coordinate = [cell](float v) { return static_cast<int>(std::floor(v / cell)); };
  for (uint32_t i = 0; i < x.size(); ++i) {
    cells[CellKey(coordinate(x[i].x), coordinate(x[i].y), coordinate(x[i].z))].push_back(i);
  }
  pairs_.clear();
  for (uint32_t i = 0; i < x.size(); ++i) {
    for (int k = 0; k < 27; ++k) {
      const auto found =
          cells.find(CellKey(coordinate(x[i].x) + k % 3 - 1, coordinate(x[i].y) + k / 3 % 3 - 1,
                             coordinate(x[i].z) + k / 9 - 1));
      if (found == cells.end()) {
        continue;
      }
      for (const uint32_t j : found->second) {
        if (j > i && !std::binary_search(neighbours_[i].begin(), neighbours_[i].end(), j)) {
          pairs_.push_back({i, j});
        }
      }
    }
  }
}

void Draper::KeepApart() {
  std::vector<glm::vec3>& x = sheet_.positions;
  for (const auto& [i, j] : pairs_) {
    const glm::vec3 d = x[j] - x[i];
    const float squared = glm::dot(d, d);
    if (squared < material_.own_gap * material_.own_gap && squared > 1e-12f) {
      const float length = std::sqrt(squared);
      const glm::vec3 move = d * (0.5f * (material_.own_gap - length) / length);
      x[i] -= move;
      x[j] += move;
      // Cloth hardly slides on cloth.
      const glm::vec3 slip = 0.1f * ((x[j] - before_[j]) - (x[i] - before_[i]));
      x[i] += slip;
      x[j] -= slip;
    }
  }
}

}  // namespace lararium::import
