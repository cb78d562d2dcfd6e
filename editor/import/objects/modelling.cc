#include "editor/import/objects/modelling.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace lararium::import {
namespace {

using stage::PropMesh;

constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;
constexpr int kRodSegments = 10;
constexpr int kStepsBetweenPoints = 4;

using Ring = std::vector<glm::vec3>;

// The Catmull-Rom cubic between b and c.
template <typename T>
T Spline(const T& a, const T& b, const T& c, const T& d, float t) {
  return 0.5f * (2.0f * b + t * (c - a) + t * t * (2.0f * a - 5.0f * b + 4.0f * c - d) +
                 t * t * t * (3.0f * (b - c) + d - a));
}

glm::vec3 Normalised(const glm::vec3& v) {
  const float length = glm::length(v);
  return length > 0.0f ? v / length : glm::vec3(0.0f, 1.0f, 0.0f);
}

// The normal at one vertex of a sheet of rings, by differences along and across.
glm::vec3 SheetNormal(std::span<const Ring> rings, size_t row, size_t column) {
  const size_t count = rings[row].size();
  const Ring& below = rings[row == 0 ? row : row - 1];
  const Ring& above = rings[row + 1 == rings.size() ? row : row + 1];
  const glm::vec3 along = above[column] - below[column];
  // Where a ring shrinks to a point, its neighbour gives the direction around.
  const auto across = [&](const Ring& ring) {
    return ring[(column + 1) % count] - ring[(column + count - 1) % count];
  };
  const glm::vec3 here = across(rings[row]);
  const glm::vec3 round = glm::length(here) > 1e-6f ? here : across(below) + across(above);
  return Normalised(glm::cross(round, along));
}

// Appends a sheet through closed rings, which turn left about the direction from ring to ring.
// Texture coordinates are turns around and metres along.
void AppendSheet(std::span<const Ring> rings, const Paint& paint, PropMesh& mesh) {
  const auto begin = static_cast<uint32_t>(mesh.positions.size());
  const auto segments = static_cast<uint32_t>(rings[0].size());
  // The first column is repeated with another texture coordinate.
  const uint32_t columns = segments + 1;
  float along = 0.0f;
  for (size_t row = 0; row < rings.size(); ++row) {
    along += row == 0 ? 0.0f : glm::distance(rings[row][0], rings[row - 1][0]);
    for (uint32_t column = 0; column < columns; ++column) {
      const glm::vec3& position = rings[row][column % segments];
      mesh.positions.push_back(position);
      mesh.normals.push_back(SheetNormal(rings, row, column % segments));
      mesh.albedo.push_back(paint(position));
      mesh.uvs.emplace_back(static_cast<float>(column) / static_cast<float>(segments), along);
    }
  }
  for (uint32_t row = 0; row + 1 < rings.size(); ++row) {
    for (uint32_t column = 0; column < segments; ++column) {
      const uint32_t a = begin + row * columns + column;
      mesh.indices.insert(mesh.indices.end(),
                          {a, a + 1, a + columns, a + 1, a + columns + 1, a + columns});
    }
  }
}

// Enough segments to make corners invisible; small objects appear small on screen.
int SegmentsOf(std::span<const OutlinePoint> outline) {
  float radius = 0.0f;
  for (const OutlinePoint& point : outline) {
    radius = std::max(radius, point.radius);
  }
  return std::clamp(static_cast<int>(12.0f + 200.0f * radius), 14, 40);
}

// Refines the outline between two of its corners.
std::vector<OutlinePoint> Refined(std::span<const OutlinePoint> outline) {
  std::vector<OutlinePoint> fine;
  const auto at = [&](size_t i) { return glm::vec2(outline[i].radius, outline[i].height); };
  for (size_t i = 0; i + 1 < outline.size(); ++i) {
    const glm::vec2 before = i == 0 ? at(i) : at(i - 1);
    const glm::vec2 after = i + 2 < outline.size() ? at(i + 2) : at(i + 1);
    for (int step = 0; step < kStepsBetweenPoints; ++step) {
      const float t = static_cast<float>(step) / kStepsBetweenPoints;
      const glm::vec2 p = Spline(before, at(i), at(i + 1), after, t);
      fine.push_back({std::max(p.x, 0.0f), p.y});
    }
  }
  fine.push_back(outline.back());
  return fine;
}

Ring CircleOf(const OutlinePoint& point, int segments, float irregularity) {
  Ring ring(segments);
  for (int k = 0; k < segments; ++k) {
    const float angle = kTurn * static_cast<float>(k) / static_cast<float>(segments);
    const glm::vec3 direction(std::cos(angle), 0.0f, -std::sin(angle));
    const float wobble =
        irregularity *
        ValueNoise(2.0f * direction + glm::vec3(0.0f, 12.0f * point.height, 0.0f), 1);
    const float radius = point.radius > 0.0f ? std::max(point.radius + wobble, 0.0f) : 0.0f;
    ring[k] = radius * direction + glm::vec3(0.0f, point.height, 0.0f);
  }
  return ring;
}

// Any unit vector perpendicular to `direction`.
glm::vec3 AnyAcross(const glm::vec3& direction) {
  const glm::vec3 helper =
      std::abs(direction.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
  return Normalised(glm::cross(direction, helper));
}

std::vector<PathPoint> Refined(std::span<const PathPoint> path) {
  std::vector<PathPoint> fine;
  const auto at = [&](ptrdiff_t i) {
    const PathPoint& p = path[std::clamp<ptrdiff_t>(i, 0, std::ssize(path) - 1)];
    return glm::vec4(p.position, p.radius);
  };
  for (ptrdiff_t i = 0; i + 1 < std::ssize(path); ++i) {
    for (int step = 0; step < kStepsBetweenPoints; ++step) {
      const float t = static_cast<float>(step) / kStepsBetweenPoints;
      const glm::vec4 p = Spline(at(i - 1), at(i), at(i + 1), at(i + 2), t);
      fine.push_back({glm::vec3(p), std::max(p.w, 1e-4f)});
    }
  }
  fine.push_back(path.back());
  return fine;
}

}  // namespace

PropMesh Turned(std::span<const OutlinePoint> outline, const Paint& paint, float irregularity) {
  PropMesh mesh;
  const int segments = SegmentsOf(outline);
  size_t begin = 0;
  for (size_t i = 1; i < outline.size(); ++i) {
    if (!outline[i].corner && i + 1 != outline.size()) {
      continue;
    }
    std::vector<Ring> rings;
    for (const OutlinePoint& point : Refined(outline.subspan(begin, i - begin + 1))) {
      rings.push_back(CircleOf(point, segments, irregularity));
    }
    AppendSheet(rings, paint, mesh);
    begin = i;
  }
  return mesh;
}

PropMesh Rod(std::span<const PathPoint> path, const Paint& paint) {
  const std::vector<PathPoint> fine = Refined(path);
  const auto tangent = [&](size_t i) {
    return Normalised(fine[std::min(i + 1, fine.size() - 1)].position -
                      fine[i == 0 ? 0 : i - 1].position);
  };
  std::vector<Ring> rings;
  glm::vec3 across = AnyAcross(tangent(0));
  const auto add_ring = [&](size_t i, float radius) {
    const glm::vec3 along = tangent(i);
    // Transported from ring to ring, so that the rod does not twist.
    across = Normalised(across - glm::dot(across, along) * along);
    const glm::vec3 other = glm::cross(along, across);
    Ring& ring = rings.emplace_back(kRodSegments);
    for (int k = 0; k < kRodSegments; ++k) {
      const float angle = kTurn * static_cast<float>(k) / kRodSegments;
      ring[k] = fine[i].position + radius * (std::cos(angle) * across + std::sin(angle) * other);
    }
  };
  add_ring(0, 0.0f);
  for (size_t i = 0; i < fine.size(); ++i) {
    add_ring(i, fine[i].radius);
  }
  add_ring(fine.size() - 1, 0.0f);
  PropMesh mesh;
  AppendSheet(rings, paint, mesh);
  return mesh;
}

PropMesh Block(const glm::vec3& low, const glm::vec3& high, float edge, const Paint& paint) {
  const glm::vec3 center = 0.5f * (low + high);
  const glm::vec3 half = 0.5f * (high - low);
  const float round = std::min({edge, half.x, half.y, half.z});
  // Vertices along a side; half of them form each rounded edge.
  const int grid = std::max({half.x, half.y, half.z}) > 0.05f ? 6 : 4;
  const auto coordinate = [&](int i, float extent) {
    const int from_edge = i < grid / 2 ? i : grid - 1 - i;
    const float share = static_cast<float>(from_edge) / static_cast<float>(grid / 2 - 1);
    const float distance = extent - round * share;
    return i < grid / 2 ? -distance : distance;
  };
  PropMesh mesh;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const float side = face % 2 == 0 ? 1.0f : -1.0f;
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const auto begin = static_cast<uint32_t>(mesh.positions.size());
    for (int i = 0; i < grid; ++i) {
      for (int k = 0; k < grid; ++k) {
        glm::vec3 on_box;
        on_box[axis] = side * half[axis];
        on_box[u] = coordinate(i, half[u]);
        on_box[v] = side * coordinate(k, half[v]);
        const glm::vec3 inner = glm::clamp(on_box, round - half, half - round);
        const glm::vec3 normal = Normalised(on_box - inner);
        mesh.positions.push_back(center + inner + round * normal);
        mesh.normals.push_back(normal);
        mesh.albedo.push_back(paint(mesh.positions.back()));
        mesh.uvs.emplace_back(on_box[u], on_box[v]);
      }
    }
    const auto step = static_cast<uint32_t>(grid);
    for (uint32_t i = 0; i + 1 < step; ++i) {
      for (uint32_t k = 0; k + 1 < step; ++k) {
        const uint32_t a = begin + i * step + k;
        mesh.indices.insert(mesh.indices.end(),
                            {a, a + step, a + 1, a + 1, a + step, a + step + 1});
      }
    }
  }
  return mesh;
}

void Append(const PropMesh& mesh, PropMesh& to, const stage::Pose& to_from_mesh) {
  const auto begin = static_cast<uint32_t>(to.positions.size());
  for (const glm::vec3& position : mesh.positions) {
    to.positions.push_back(to_from_mesh * position);
  }
  for (const glm::vec3& normal : mesh.normals) {
    to.normals.push_back(to_from_mesh.rotation * normal);
  }
  to.albedo.insert(to.albedo.end(), mesh.albedo.begin(), mesh.albedo.end());
  to.uvs.insert(to.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
  for (const uint32_t index : mesh.indices) {
    to.indices.push_back(begin + index);
  }
}

}  // namespace lararium::import
