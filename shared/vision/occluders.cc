#include "shared/vision/occluders.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "shared/core/check.h"

namespace lararium::vision {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

// The distance at which a ray enters a box, in lengths of its direction, of which `inverse` holds
// the reciprocals; infinite if the ray does not meet the box before `last`.
float EntryOf(const Vector3f& eye,
              const Vector3f& inverse,
              float last,
              const Vector3f& least,
              const Vector3f& most) {
  const Vector3f a = (least - eye).cwiseProduct(inverse);
  const Vector3f b = (most - eye).cwiseProduct(inverse);
  const float enter = std::max(a.cwiseMin(b).maxCoeff(), 0.0f);
  const float leave = std::min(a.cwiseMax(b).minCoeff(), last);
  return enter <= leave ? enter : std::numeric_limits<float>::infinity();
}

// The nearest point on the segment from a to a + edge.
Vector3f NearestOnEdge(const Vector3f& point, const Vector3f& a, const Vector3f& edge) {
  const float where = edge.dot(point - a) / edge.squaredNorm();
  return a + std::clamp(where, 0.0f, 1.0f) * edge;
}

// The nearest point of a triangle: the foot of the perpendicular if it lies inside, otherwise a
// point on one of the edges.
Vector3f NearestOnTriangle(const Vector3f& point,
                           const Vector3f& corner,
                           const Vector3f& edge1,
                           const Vector3f& edge2,
                           const Vector3f& normal) {
  const Vector3f foot = point - normal.dot(point - corner) * normal;
  const Vector3f from = foot - corner;
  const float area = edge1.cross(edge2).dot(normal);  // Twice the triangle's area; positive.
  const float u = from.cross(edge2).dot(normal) / area;
  const float v = edge1.cross(from).dot(normal) / area;
  if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f) {
    return foot;
  }
  const std::array<Vector3f, 3> candidates = {NearestOnEdge(point, corner, edge1),
                                              NearestOnEdge(point, corner, edge2),
                                              NearestOnEdge(point, corner + edge1, edge2 - edge1)};
  return *std::min_element(candidates.begin(), candidates.end(),
                           [&](const Vector3f& a, const Vector3f& b) {
                             return (a - point).squaredNorm() < (b - point).squaredNorm();
                           });
}

}  // namespace

OccluderMesh Placed(const geometry::TriangleMesh& mesh,
                    const geometry::Similarity3& target_from_mesh) {
  OccluderMesh placed;
  placed.positions.reserve(mesh.positions.size());
  for (const glm::vec3& p : mesh.positions) {
    placed.positions.push_back((target_from_mesh * Vector3d(p.x, p.y, p.z)).cast<float>());
  }
  placed.indices = mesh.indices;
  return placed;
}

OccluderTree::OccluderTree(const OccluderMesh& mesh) {
  std::vector<Triangle> triangles;
  std::vector<Vector3f> middles;
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    CHECK(std::max({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]}) <
          mesh.positions.size());
    const Vector3f& a = mesh.positions[mesh.indices[i]];
    const Vector3f& b = mesh.positions[mesh.indices[i + 1]];
    const Vector3f& c = mesh.positions[mesh.indices[i + 2]];
    const Vector3f normal = (b - a).cross(c - a);
    if (normal.squaredNorm() > 0.0f) {
      triangles.push_back({a, b - a, c - a, normal.normalized()});
      middles.push_back((a + b + c) / 3.0f);
    }
  }
  std::vector<uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  if (!order.empty()) {
    triangles_.reserve(order.size());
    Build(order, triangles, middles);
  }
}

// Splits the triangles at the median of their centroids along the longest axis.
void OccluderTree::Build(std::span<uint32_t> order,
                         std::span<const Triangle> triangles,
                         std::span<const Vector3f> middles) {
  Eigen::AlignedBox3f box;
  Eigen::AlignedBox3f spread;
  for (const uint32_t i : order) {
    const Triangle& t = triangles[i];
    box.extend(t.corner).extend(t.corner + t.edge1).extend(t.corner + t.edge2);
    spread.extend(middles[i]);
  }
  const size_t index = nodes_.size();
  nodes_.push_back({box.min(), box.max()});
  if (order.size() <= kLeaf) {
    nodes_[index].begin = static_cast<uint32_t>(triangles_.size());
    nodes_[index].count = static_cast<uint32_t>(order.size());
    for (const uint32_t i : order) {
      triangles_.push_back(triangles[i]);
    }
    return;
  }
  Eigen::Index axis = 0;
  spread.sizes().maxCoeff(&axis);
  const size_t half = order.size() / 2;
  std::nth_element(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
      [&](uint32_t a, uint32_t b) {
        return middles[a][axis] != middles[b][axis] ? middles[a][axis] < middles[b][axis] : a < b;
      });
  Build(order.first(half), triangles, middles);
  nodes_[index].begin = static_cast<uint32_t>(nodes_.size());
  Build(order.subspan(half), triangles, middles);
}

template <typename Visit>
void OccluderTree::ForEachHit(const Vector3f& eye,
                              const Vector3f& way,
                              const float& last,
                              const Visit& visit) const {
  if (nodes_.empty()) {
    return;
  }
  // Avoids division by zero, and therefore NaN if the eye lies in the plane of a box's side.
  constexpr float kTiny = 1e-20f;
  const Vector3f inverse = way.unaryExpr(
      [](float v) { return 1.0f / (std::abs(v) > kTiny ? v : std::copysign(kTiny, v)); });
  std::array<uint32_t, kDeepest> stack;
  size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const uint32_t at = stack[--waiting];
    const Node& node = nodes_[at];
    if (EntryOf(eye, inverse, last, node.least, node.most) > last) {
      continue;
    }
    if (node.count == 0) {
      stack[waiting++] = node.begin;
      stack[waiting++] = at + 1;
      continue;
    }
    for (const Triangle& t : std::span(triangles_).subspan(node.begin, node.count)) {
      // Moeller & Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
      const Vector3f p = way.cross(t.edge2);
      const float determinant = t.edge1.dot(p);
      const Vector3f from = eye - t.corner;
      const Vector3f q = from.cross(t.edge1);
      const float u = from.dot(p) / determinant;
      const float v = way.dot(q) / determinant;
      const float where = t.edge2.dot(q) / determinant;
      // A triangle parallel to the ray gives NaN, for which the comparisons are false.
      if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f && where > 0.0f && visit(t, where)) {
        return;
      }
    }
  }
}

bool OccluderTree::Hides(const Vector3f& eye, const Vector3f& point, float bias) const {
  const Vector3f way = point - eye;
  const float length = way.norm();
  // Beyond this, the point is nearer than bias to the hit and so to the triangle's plane.
  const float last = 1.0f - bias / length;
  bool hides = false;
  if (last > 0.0f) {
    ForEachHit(eye, way, last, [&](const Triangle& triangle, float where) {
      hides = (1.0f - where) * std::abs(triangle.normal.dot(way)) > bias;
      return hides;
    });
  }
  return hides;
}

std::optional<OccluderTree::Hit> OccluderTree::FirstHit(const Vector3f& eye,
                                                        const Vector3f& direction,
                                                        float nearest,
                                                        float farthest) const {
  std::optional<Hit> first;
  float last = farthest;
  ForEachHit(eye, direction, last, [&](const Triangle& triangle, float where) {
    if (where >= nearest && where < last) {
      first = {where, triangle.normal};
      last = where;
    }
    return false;
  });
  return first;
}

std::optional<OccluderTree::Nearest> OccluderTree::NearestTo(const Vector3f& point,
                                                             float within) const {
  std::optional<Nearest> nearest;
  float least = within * within;
  // Squared distance from the point to a node's box.
  const auto distance_to = [&](uint32_t at) {
    const Node& node = nodes_[at];
    return (point - point.cwiseMax(node.least).cwiseMin(node.most)).squaredNorm();
  };
  std::array<uint32_t, kDeepest> stack;
  size_t waiting = 0;
  if (!nodes_.empty()) {
    stack[waiting++] = 0;
  }
  while (waiting > 0) {
    const uint32_t at = stack[--waiting];
    const Node& node = nodes_[at];
    if (!(distance_to(at) < least)) {
      continue;
    }
    if (node.count == 0) {
      // The nearer half is visited first.
      const bool left_first = distance_to(at + 1) <= distance_to(node.begin);
      stack[waiting++] = left_first ? node.begin : at + 1;
      stack[waiting++] = left_first ? at + 1 : node.begin;
      continue;
    }
    for (const Triangle& t : std::span(triangles_).subspan(node.begin, node.count)) {
      const Vector3f foot = NearestOnTriangle(point, t.corner, t.edge1, t.edge2, t.normal);
      const float distance = (foot - point).squaredNorm();
      if (distance < least) {
        least = distance;
        nearest = {0.0f, foot, t.normal};
      }
    }
  }
  if (nearest) {
    nearest->distance = std::sqrt(least);
  }
  return nearest;
}

void OccluderSet::Set(std::span<const OccluderMesh> meshes) {
  trees_.clear();
  for (const OccluderMesh& mesh : meshes) {
    trees_.emplace_back(mesh);
  }
  beliefs_.assign(trees_.size(), {});
}

uint32_t OccluderSet::HiddenBy(const Vector3d& eye, const Vector3d& point, double bias) const {
  uint32_t found = kNone;
  for (uint32_t i = 0; i < trees_.size(); ++i) {
    if ((found == kNone || beliefs_[i].believed) &&
        trees_[i].Hides(eye.cast<float>(), point.cast<float>(), static_cast<float>(bias))) {
      found = i;
      if (beliefs_[i].believed) {
        break;
      }
    }
  }
  return found;
}

void OccluderSet::Note(uint32_t occluder, bool seen) {
  constexpr float kMemory = 64.0f;  // Number of points after which older ones begin to fade.
  constexpr float kLeastLooked = 8.0f;
  // An occluder becomes trusted while the share of found points is below kBelieve (some are found
  // by chance or past an edge) and loses trust at kDisbelieve.
  constexpr float kBelieve = 0.2f;
  constexpr float kDisbelieve = 0.4f;
  Belief& belief = beliefs_[occluder];
  const float fade = belief.looked >= kMemory ? 1.0f - 1.0f / kMemory : 1.0f;
  belief.looked = fade * belief.looked + 1.0f;
  belief.seen = fade * belief.seen + (seen ? 1.0f : 0.0f);
  const float limit = belief.believed ? kDisbelieve : kBelieve;
  belief.believed = belief.looked >= kLeastLooked && belief.seen < limit * belief.looked;
}

bool OccluderSet::Doubt() {
  const bool any = std::any_of(beliefs_.begin(), beliefs_.end(),
                               [](const Belief& belief) { return belief.believed; });
  std::fill(beliefs_.begin(), beliefs_.end(), Belief{});
  return any;
}

}  // namespace lararium::vision
