#include "editor/bake/blockers.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "shared/core/parallel.h"
#include "shared/core/units.h"
#include "shared/render/passes/screen_bounds.h"

namespace lararium::bake {
namespace {

using Blocker = human::LightTransfer::Blocker;
constexpr size_t kGridPoints = 40'000;  // Most points in the box about a model.
constexpr int kRays = 48;
constexpr int kMaxEscapes = 4;  // Most rays that may escape from a point that counts as inside.
// A joint with fewer points than this gives them to the nearest cluster.
constexpr size_t kFewPoints = 6;
constexpr int kRefinements = 8;  // Passes of k-means.

struct Inside {
  glm::vec3 position = glm::vec3(0.0f);
  uint16_t joint = 0;
};

// Spreads `count` directions evenly over the sphere (a Fibonacci lattice).
glm::vec3 LatticeDirection(int i, int count) {
  const float y = 1.0f - (2.0f * static_cast<float>(i) + 1.0f) / static_cast<float>(count);
  const float radius = std::sqrt(std::max(0.0f, 1.0f - y * y));
  const float angle = static_cast<float>(i) * kPiF * (3.0f - std::sqrt(5.0f));
  return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

render::Box BoxOf(std::span<const SurfaceMesh> meshes) {
  render::Box box;
  for (const SurfaceMesh& mesh : meshes) {
    for (const glm::vec3& position : mesh.positions) {
      box.Extend(position);
    }
  }
  return box;
}

// The joint of the nearest surfaces that rays from a point hit; nullopt if too many rays
// escape.
std::optional<uint16_t> JointAround(const RayScene& rays,
                                    std::span<const SurfaceMesh> meshes,
                                    const VertexJoints& joints,
                                    const glm::vec3& point) {
  int escapes = 0;
  RayHit nearest;
  nearest.distance = std::numeric_limits<float>::max();
  for (int i = 0; i < kRays; ++i) {
    const std::optional<RayHit> hit = rays.Trace(point, LatticeDirection(i, kRays));
    if (!hit) {
      if (++escapes > kMaxEscapes) {
        return std::nullopt;
      }
    } else if (hit->distance < nearest.distance) {
      nearest = *hit;
    }
  }
  const uint32_t vertex = meshes[nearest.mesh].indices[3 * nearest.triangle];
  return joints[nearest.mesh][vertex];
}

// The grid points that are inside, and the volume of a grid cell.
std::pair<std::vector<Inside>, float> FindInside(const RayScene& rays,
                                                 std::span<const SurfaceMesh> meshes,
                                                 const VertexJoints& joints) {
  const render::Box box = BoxOf(meshes);
  const glm::vec3 size = glm::max(box.high - box.low, glm::vec3(1e-3f));
  const float step = std::cbrt(size.x * size.y * size.z / static_cast<float>(kGridPoints));
  const glm::ivec3 counts = glm::max(glm::ivec3(size / step), glm::ivec3(1));
  std::vector<std::vector<Inside>> slices(static_cast<size_t>(counts.y));
  ParallelFor(slices.size(), [&](size_t y) {
    for (int z = 0; z < counts.z; ++z) {
      for (int x = 0; x < counts.x; ++x) {
        const glm::vec3 cell(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                             static_cast<float>(z) + 0.5f);
        const glm::vec3 point = box.low + cell / glm::vec3(counts) * size;
        if (const auto joint = JointAround(rays, meshes, joints, point)) {
          slices[y].push_back({point, *joint});
        }
      }
    }
  });
  std::vector<Inside> inside;
  for (const std::vector<Inside>& slice : slices) {
    inside.insert(inside.end(), slice.begin(), slice.end());
  }
  const glm::vec3 cell = size / glm::vec3(counts);
  return {std::move(inside), cell.x * cell.y * cell.z};
}

struct Cluster {
  uint16_t joint = 0;
  std::vector<glm::vec3> points;

  glm::vec3 Mean() const {
    glm::vec3 sum(0.0f);
    for (const glm::vec3& point : points) {
      sum += point;
    }
    return sum / static_cast<float>(std::max<size_t>(points.size(), 1));
  }
  // Sum of the squared distances from the mean.
  float Spread() const {
    const glm::vec3 mean = Mean();
    float sum = 0.0f;
    for (const glm::vec3& point : points) {
      sum += glm::dot(point - mean, point - mean);
    }
    return sum;
  }
};

// One cluster for each joint with enough points; the other points join the nearest cluster.
std::vector<Cluster> ClusterByJoint(const std::vector<Inside>& inside) {
  std::vector<Cluster> clusters;
  std::vector<Inside> strays;
  uint16_t last = 0;
  for (const Inside& point : inside) {
    last = std::max(last, point.joint);
  }
  std::vector<std::vector<glm::vec3>> by_joint(static_cast<size_t>(last) + 1);
  for (const Inside& point : inside) {
    by_joint[point.joint].push_back(point.position);
  }
  for (size_t joint = 0; joint < by_joint.size(); ++joint) {
    if (by_joint[joint].size() >= kFewPoints) {
      clusters.push_back({static_cast<uint16_t>(joint), by_joint[joint]});
    } else {
      for (const glm::vec3& point : by_joint[joint]) {
        strays.push_back({point, static_cast<uint16_t>(joint)});
      }
    }
  }
  if (clusters.empty() && !strays.empty()) {
    clusters.push_back({strays.front().joint, {}});
  }
  std::vector<glm::vec3> means;
  for (const Cluster& cluster : clusters) {
    means.push_back(cluster.points.empty() ? strays.front().position : cluster.Mean());
  }
  for (const Inside& stray : strays) {
    const auto nearest =
        std::min_element(means.begin(), means.end(), [&](const auto& a, const auto& b) {
          return glm::distance(a, stray.position) < glm::distance(b, stray.position);
        });
    clusters[static_cast<size_t>(nearest - means.begin())].points.push_back(stray.position);
  }
  return clusters;
}

// Splits a cluster along its longest extent, then improves the halves by k-means with two
// means.
std::pair<Cluster, Cluster> Split(const Cluster& cluster) {
  const glm::vec3 mean = cluster.Mean();
  glm::vec3 far = mean;
  for (const glm::vec3& point : cluster.points) {
    far = glm::distance(point, mean) > glm::distance(far, mean) ? point : far;
  }
  std::pair<Cluster, Cluster> halves;
  glm::vec3 a = far;
  glm::vec3 b = 2.0f * mean - far;
  for (int pass = 0; pass < kRefinements; ++pass) {
    halves = {{cluster.joint, {}}, {cluster.joint, {}}};
    for (const glm::vec3& point : cluster.points) {
      const bool first = glm::distance(point, a) <= glm::distance(point, b);
      (first ? halves.first : halves.second).points.push_back(point);
    }
    a = halves.first.points.empty() ? a : halves.first.Mean();
    b = halves.second.points.empty() ? b : halves.second.Mean();
  }
  return halves;
}

}  // namespace

VertexJoints StrongestJoints(const human::Human& human) {
  VertexJoints joints;
  for (const human::SkinnedMesh& mesh : human.meshes) {
    std::vector<uint16_t>& strongest = joints.emplace_back(mesh.positions.size());
    for (size_t v = 0; v < strongest.size(); ++v) {
      int best = 0;
      for (int i = 1; i < 4; ++i) {
        best = mesh.weights[v][i] > mesh.weights[v][best] ? i : best;
      }
      strongest[v] = mesh.joints[v][static_cast<size_t>(best)];
    }
  }
  return joints;
}

Result<std::vector<Blocker>> FitBlockers(std::span<const SurfaceMesh> rest,
                                         const VertexJoints& joints,
                                         size_t count) {
  LARARIUM_ASSIGN_OR_RETURN(const RayScene rays, RaysAt(rest));
  const auto [inside, volume] = FindInside(rays, rest, joints);
  std::vector<Cluster> clusters = ClusterByJoint(inside);
  while (clusters.size() < count) {
    const auto widest = std::max_element(
        clusters.begin(), clusters.end(),
        [](const Cluster& a, const Cluster& b) { return a.Spread() < b.Spread(); });
    if (widest == clusters.end() || widest->points.size() < 2) {
      break;
    }
    auto [first, second] = Split(*widest);
    if (first.points.empty() || second.points.empty()) {
      break;
    }
    *widest = std::move(first);
    clusters.push_back(std::move(second));
  }
  std::sort(clusters.begin(), clusters.end(),
            [](const Cluster& a, const Cluster& b) { return a.points.size() > b.points.size(); });
  clusters.resize(std::min(clusters.size(), count));
  std::vector<Blocker> blockers;
  for (const Cluster& cluster : clusters) {
    const float cluster_volume = volume * static_cast<float>(cluster.points.size());
    blockers.push_back(
        {cluster.joint, cluster.Mean(), std::cbrt(3.0f * cluster_volume / (4.0f * kPiF))});
  }
  return blockers;
}

}  // namespace lararium::bake
