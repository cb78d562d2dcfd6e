#include "editor/import/cast/implicit_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include "shared/core/check.h"

namespace lararium::import {
namespace {

constexpr uint32_t kNoVertex = 0xffffffff;
constexpr float kGradientStep = 1e-3f;  // metres
constexpr int kSmoothingRounds = 4;

// The gradient by differences towards the corners of a tetrahedron.
glm::vec3 Gradient(const DistanceField& field, const glm::vec3& p) {
  constexpr glm::vec3 kCorners[4] = {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}};
  glm::vec3 gradient(0.0f);
  for (const glm::vec3& corner : kCorners) {
    gradient += field(p + kGradientStep * corner) * corner;
  }
  return gradient / (4.0f * kGradientStep);
}

// Moves p to the zero set by a few Newton steps along the gradient, each at most one cell long,
// so that a vertex cannot reach another part of the surface.
glm::vec3 ProjectOnSurface(const DistanceField& field, glm::vec3 p, float cell, int steps) {
  for (int i = 0; i < steps; ++i) {
    const glm::vec3 gradient = Gradient(field, p);
    const float squared = glm::dot(gradient, gradient);
    if (squared < 1e-6f) {
      break;
    }
    const glm::vec3 step = -field(p) / squared * gradient;
    p += step * std::min(1.0f, 0.5f * cell / std::max(glm::length(step), 1e-9f));
  }
  return p;
}

// Values of the field at the corners of a grid of cubes.
class Grid {
 public:
  Grid(const DistanceField& field, const Box& box, float cell) : low_(box.low - cell), cell_(cell) {
    size_ = glm::ivec3(glm::ceil((box.high - box.low) / cell)) + 3;
    values_.reserve(static_cast<size_t>(size_.x) * size_.y * size_.z);
    for (int z = 0; z < size_.z; ++z) {
      for (int y = 0; y < size_.y; ++y) {
        for (int x = 0; x < size_.x; ++x) {
          values_.push_back(field(Corner({x, y, z})));
        }
      }
    }
  }

  const glm::ivec3& size() const { return size_; }
  glm::vec3 Corner(const glm::ivec3& c) const { return low_ + cell_ * glm::vec3(c); }
  size_t Index(const glm::ivec3& c) const {
    return (static_cast<size_t>(c.z) * size_.y + c.y) * size_.x + c.x;
  }
  float Value(const glm::ivec3& c) const { return values_[Index(c)]; }

 private:
  glm::vec3 low_;
  float cell_;
  glm::ivec3 size_;
  std::vector<float> values_;
};

glm::ivec3 CornerOffset(int corner) { return {corner & 1, (corner >> 1) & 1, corner >> 2}; }

// Edge of a cube along an axis, at the given offsets in the next two axes.
int CubeEdge(int axis, int next, int after_next) { return 4 * axis + next + 2 * after_next; }

// Finds the edges of a cube that the surface crosses, and groups them by sheets of the surface:
// the crossings are joined face by face. If all four edges of a face are crossed, those around
// an inside corner are joined, so that both cubes at the face decide alike and the surface
// stays manifold (dual marching cubes: Nielson, IEEE Visualization 2004).
class CubeSheets {
 public:
  CubeSheets(const Grid& grid, const glm::ivec3& cell) {
    for (int corner = 0; corner < 8; ++corner) {
      inside_[corner] = grid.Value(cell + CornerOffset(corner)) < 0.0f;
    }
    for (int edge = 0; edge < 12; ++edge) {
      sheet_[edge] = edge;
    }
    for (int axis = 0; axis < 3; ++axis) {
      JoinOnFace(axis, 0);
      JoinOnFace(axis, 1);
    }
  }

  bool Crosses(int corner, int other) const { return inside_[corner] != inside_[other]; }
  int Sheet(int edge) const { return sheet_[edge]; }

 private:
  void JoinOnFace(int axis, int side) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto corner = [&](int a, int b) { return side << axis | a << u | b << v; };
    const int along_u[2] = {CubeEdge(u, 0, side), CubeEdge(u, 1, side)};
    const int along_v[2] = {CubeEdge(v, side, 0), CubeEdge(v, side, 1)};
    std::array<int, 4> crossed;
    int count = 0;
    for (int i = 0; i < 2; ++i) {
      if (Crosses(corner(0, i), corner(1, i))) {
        crossed[count++] = along_u[i];
      }
      if (Crosses(corner(i, 0), corner(i, 1))) {
        crossed[count++] = along_v[i];
      }
    }
    if (count == 2) {
      Join(crossed[0], crossed[1]);
    }
    for (int a = 0; count == 4 && a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        if (inside_[corner(a, b)]) {
          Join(along_u[b], along_v[a]);
        }
      }
    }
  }

  void Join(int a, int b) {
    const int from = sheet_[a], to = sheet_[b];
    std::replace(sheet_.begin(), sheet_.end(), from, to);
  }

  std::array<bool, 8> inside_;
  std::array<int, 12> sheet_;
};

// For each edge of a cube, the vertex of the sheet that crosses it.
using CubeVertices = std::array<uint32_t, 12>;

// Adds a vertex for every sheet in a cube: the mean of its crossings. Returns false if the
// surface does not pass through the cube.
bool AddCubeVertices(const Grid& grid,
                     const glm::ivec3& cell,
                     std::vector<glm::vec3>& positions,
                     CubeVertices& vertices) {
  const CubeSheets sheets(grid, cell);
  std::array<glm::vec4, 12> sums{};  // Sum for each sheet; w counts.
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      const int other = corner | (1 << axis);
      if (other == corner || !sheets.Crosses(corner, other)) {
        continue;
      }
      const glm::ivec3 offset = CornerOffset(corner);
      const glm::ivec3 a = cell + offset, b = cell + CornerOffset(other);
      const float share = grid.Value(a) / (grid.Value(a) - grid.Value(b));
      const int edge = CubeEdge(axis, offset[(axis + 1) % 3], offset[(axis + 2) % 3]);
      sums[sheets.Sheet(edge)] += glm::vec4(glm::mix(grid.Corner(a), grid.Corner(b), share), 1.0f);
    }
  }
  CubeVertices of_sheet;
  of_sheet.fill(kNoVertex);
  bool any = false;
  for (int sheet = 0; sheet < 12; ++sheet) {
    if (sums[sheet].w > 0.0f) {
      of_sheet[sheet] = static_cast<uint32_t>(positions.size());
      positions.emplace_back(glm::vec3(sums[sheet]) / sums[sheet].w);
      any = true;
    }
  }
  for (int edge = 0; edge < 12; ++edge) {
    vertices[edge] = of_sheet[sheets.Sheet(edge)];
  }
  return any;
}

void AddQuad(std::vector<uint32_t>& indices,
             const std::vector<glm::vec3>& positions,
             const std::array<uint32_t, 4>& q) {
  const bool first_diagonal = glm::distance(positions[q[0]], positions[q[2]]) <
                              glm::distance(positions[q[1]], positions[q[3]]);
  if (first_diagonal) {
    indices.insert(indices.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
  } else {
    indices.insert(indices.end(), {q[0], q[1], q[3], q[1], q[2], q[3]});
  }
}

// The vertices of the cubes that the surface passes through.
struct NetVertices {
  std::vector<uint32_t> cube_of_cell;  // kNoVertex if there is none.
  std::vector<CubeVertices> cubes;
};

// Adds a quad across every grid edge that the surface crosses, through the vertices of the four
// cubes around it.
void AddQuadsOfCorner(const Grid& grid,
                      const NetVertices& net,
                      const glm::ivec3& corner,
                      geometry::TriangleMesh& mesh) {
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 along(0), side_u(0), side_v(0);
    along[axis] = 1;
    side_u[(axis + 1) % 3] = 1;
    side_v[(axis + 2) % 3] = 1;
    const bool inside = grid.Value(corner) < 0.0f;
    if (inside == (grid.Value(corner + along) < 0.0f)) {
      continue;
    }
    const auto vertex = [&](int u, int v) {
      const uint32_t cube = net.cube_of_cell[grid.Index(corner - u * side_u - v * side_v)];
      return net.cubes[cube][CubeEdge(axis, u, v)];
    };
    std::array<uint32_t, 4> quad = {vertex(1, 1), vertex(0, 1), vertex(0, 0), vertex(1, 0)};
    if (!inside) {
      std::swap(quad[1], quad[3]);
    }
    AddQuad(mesh.indices, mesh.positions, quad);
  }
}

geometry::TriangleMesh SurfaceNet(const Grid& grid) {
  geometry::TriangleMesh mesh;
  const glm::ivec3 size = grid.size();
  NetVertices net;
  net.cube_of_cell.assign(static_cast<size_t>(size.x) * size.y * size.z, kNoVertex);
  const auto for_each = [&](int first, const auto& visit) {
    for (int z = first; z < size.z - 1; ++z) {
      for (int y = first; y < size.y - 1; ++y) {
        for (int x = first; x < size.x - 1; ++x) {
          visit(glm::ivec3(x, y, z));
        }
      }
    }
  };
  for_each(0, [&](const glm::ivec3& cell) {
    CubeVertices vertices;
    if (AddCubeVertices(grid, cell, mesh.positions, vertices)) {
      net.cube_of_cell[grid.Index(cell)] = static_cast<uint32_t>(net.cubes.size());
      net.cubes.push_back(vertices);
    }
  });
  for_each(1, [&](const glm::ivec3& corner) { AddQuadsOfCorner(grid, net, corner, mesh); });
  return mesh;
}

// Moves every vertex half-way to the mean of its neighbours.
void Smooth(geometry::TriangleMesh& mesh) {
  std::vector<glm::vec3> sums(mesh.positions.size(), glm::vec3(0.0f));
  std::vector<float> counts(mesh.positions.size(), 0.0f);
  for (size_t i = 0; i < mesh.indices.size(); ++i) {
    const uint32_t from = mesh.indices[i];
    const uint32_t to = mesh.indices[i % 3 == 2 ? i - 2 : i + 1];
    sums[from] += mesh.positions[to];
    counts[from] += 1.0f;
  }
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] = 0.5f * (mesh.positions[v] + sums[v] / std::max(counts[v], 1.0f));
  }
}

Loft::Station Hermite(const Loft::Station& a,
                      const Loft::Station& b,
                      const Loft::Station& slope_a,
                      const Loft::Station& slope_b,
                      float t) {
  const float span = b.t - a.t;
  const float s = (t - a.t) / span;
  const float h1 = s * s * (3.0f - 2.0f * s);
  const float h0 = 1.0f - h1;
  const float g0 = span * s * (1.0f - s) * (1.0f - s);
  const float g1 = -span * s * s * (1.0f - s);
  return {t, h0 * a.center + h1 * b.center + g0 * slope_a.center + g1 * slope_b.center,
          h0 * a.radii + h1 * b.radii + g0 * slope_a.radii + g1 * slope_b.radii,
          glm::mix(a.exponent, b.exponent, s)};
}

// Slopes of a spline through the stations, by differences of neighbours.
std::vector<Loft::Station> Slopes(const std::vector<Loft::Station>& stations) {
  std::vector<Loft::Station> slopes;
  for (size_t i = 0; i < stations.size(); ++i) {
    const Loft::Station& before = stations[i == 0 ? 0 : i - 1];
    const Loft::Station& after = stations[std::min(i + 1, stations.size() - 1)];
    const float span = after.t - before.t;
    slopes.push_back({stations[i].t, (after.center - before.center) / span,
                      (after.radii - before.radii) / span});
  }
  return slopes;
}

}  // namespace

float SmoothUnion(float a, float b, float radius) {
  const float overlap = std::max(radius - std::abs(a - b), 0.0f) / radius;
  return std::min(a, b) - 0.25f * radius * overlap * overlap;
}

float SmoothIntersection(float a, float b, float radius) { return -SmoothUnion(-a, -b, radius); }

float RoundCone(const glm::vec3& point,
                const glm::vec3& a,
                float radius_a,
                const glm::vec3& b,
                float radius_b) {
  const glm::vec3 axis = b - a;
  const float t = glm::clamp(glm::dot(point - a, axis) / glm::dot(axis, axis), 0.0f, 1.0f);
  return glm::distance(point, a + t * axis) - glm::mix(radius_a, radius_b, t);
}

float Ellipsoid(const glm::vec3& point, const glm::vec3& center, const glm::vec3& radii) {
  const glm::vec3 scaled = (point - center) / radii;
  const float length = glm::length(scaled);
  const float slope = glm::length(scaled / radii);
  return slope < 1e-6f ? -std::min({radii.x, radii.y, radii.z}) : length * (length - 1.0f) / slope;
}

Loft::Loft(const glm::vec3& origin, const glm::mat3& actor_from_loft, std::vector<Station> stations)
    : origin_(origin),
      loft_from_actor_(glm::transpose(actor_from_loft)),
      stations_(std::move(stations)),
      slopes_(Slopes(stations_)) {
  CHECK(stations_.size() >= 2);
}

Loft::Station Loft::At(float t) const {
  t = std::clamp(t, stations_.front().t, stations_.back().t);
  size_t i = 0;
  while (i + 2 < stations_.size() && t > stations_[i + 1].t) {
    ++i;
  }
  return Hermite(stations_[i], stations_[i + 1], slopes_[i], slopes_[i + 1], t);
}

float Loft::SideDistance(const glm::vec3& point) const {
  const glm::vec3 local = loft_from_actor_ * (point - origin_);
  const Station section = At(local.y);
  const glm::vec2 offset = glm::vec2(local.x, local.z) - section.center;
  const glm::vec2 scaled = glm::abs(offset / section.radii);
  const float n = section.exponent;
  const float norm = n == 2.0f ? glm::length(scaled)
                               : std::pow(std::pow(scaled.x, n) + std::pow(scaled.y, n), 1.0f / n);
  if (norm < 1e-3f) {
    return -std::min(section.radii.x, section.radii.y);
  }
  return glm::length(offset) * (1.0f - 1.0f / norm);
}

float Loft::Distance(const glm::vec3& point, float end_fillet) const {
  const float t = (loft_from_actor_ * (point - origin_)).y;
  const float beyond_ends = std::max(stations_.front().t - t, t - stations_.back().t);
  return SmoothIntersection(SideDistance(point), beyond_ends, end_fillet);
}

glm::vec3 FieldNormal(const DistanceField& field, const glm::vec3& point) {
  const glm::vec3 gradient = Gradient(field, point);
  const float length = glm::length(gradient);
  return length > 1e-6f ? gradient / length : glm::vec3(0.0f, 1.0f, 0.0f);
}

geometry::TriangleMesh Polygonise(const DistanceField& field, const Box& box, float cell) {
  geometry::TriangleMesh mesh = SurfaceNet(Grid(field, box, cell));
  for (int round = 1; round <= kSmoothingRounds; ++round) {
    Smooth(mesh);
    for (glm::vec3& position : mesh.positions) {
      position = ProjectOnSurface(field, position, cell, round < kSmoothingRounds ? 1 : 3);
    }
  }
  for (const glm::vec3& position : mesh.positions) {
    mesh.normals.push_back(FieldNormal(field, position));
  }
  return mesh;
}

}  // namespace lararium::import
