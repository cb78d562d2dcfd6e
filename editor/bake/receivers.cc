#include "editor/bake/receivers.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "shared/core/parallel.h"

namespace lararium::bake {
namespace {

constexpr float kOffSurface = 0.02f;  // metres
// Distance that is added for opposite normals, or for following a different joint.
constexpr float kNormalDistance = 0.15f;  // metres
constexpr float kJointDistance = 0.15f;
constexpr float kPartDistance = 1e3f;

struct SurfaceVertex {
  glm::vec3 position = glm::vec3(0.0f);
  glm::vec3 normal = glm::vec3(0.0f);
  uint32_t mesh = 0;
  uint32_t vertex = 0;
  uint32_t part = 0;  // Part of a prop.
};

float Distance(const SurfaceVertex& a, const SurfaceVertex& b) {
  return glm::distance(a.position, b.position) +
         0.5f * kNormalDistance * (1.0f - glm::dot(a.normal, b.normal)) +
         (a.part == b.part ? 0.0f : kPartDistance);
}

std::vector<SurfaceVertex> AllVertices(std::span<const SurfaceMesh> meshes) {
  std::vector<SurfaceVertex> all;
  for (uint32_t m = 0; m < meshes.size(); ++m) {
    for (uint32_t v = 0; v < meshes[m].positions.size(); ++v) {
      all.push_back({meshes[m].positions[v], meshes[m].normals[v], m, v});
    }
  }
  return all;
}

std::vector<SurfaceVertex> Spread(const std::vector<SurfaceVertex>& all, size_t count) {
  std::vector<SurfaceVertex> chosen;
  std::vector<float> distance(all.size(), std::numeric_limits<float>::max());
  size_t next = 0;
  while (chosen.size() < std::min(count, all.size())) {
    chosen.push_back(all[next]);
    for (size_t i = 0; i < all.size(); ++i) {
      distance[i] = std::min(distance[i], Distance(all[i], chosen.back()));
    }
    next =
        static_cast<size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  return chosen;
}

// The weight of a joint at a vertex. `human` is null for a prop, whose parts are separated
// elsewhere.
float WeightOf(const human::Human* human, const SurfaceVertex& at, uint32_t joint) {
  if (human == nullptr) {
    return 1.0f;
  }
  const human::SkinnedMesh& mesh = human->meshes[at.mesh];
  const uint32_t vertex = at.vertex;
  float weight = 0.0f;
  for (size_t i = 0; i < 4; ++i) {
    weight += mesh.joints[vertex][i] == joint ? mesh.weights[vertex][static_cast<int>(i)] : 0.0f;
  }
  return weight;
}

struct Near {
  uint16_t receiver = 0;
  float distance = std::numeric_limits<float>::max();
};

// The four nearest receivers, then the fifth, which is the farthest.
std::array<Near, 5> FindNearest(const human::Human* human,
                                const SurfaceVertex& vertex,
                                const std::vector<SurfaceVertex>& receivers,
                                const human::LightTransfer& transfer) {
  std::array<Near, 5> nearest;
  for (size_t r = 0; r < receivers.size(); ++r) {
    float distance = Distance(vertex, receivers[r]);
    if (distance >= nearest[4].distance) {
      continue;
    }
    distance += kJointDistance * (1.0f - WeightOf(human, vertex, transfer.receivers[r].joint));
    if (distance < nearest[4].distance) {
      nearest[4] = {static_cast<uint16_t>(r), distance};
      std::sort(nearest.begin(), nearest.end(),
                [](const Near& a, const Near& b) { return a.distance < b.distance; });
    }
  }
  return nearest;
}

// Weights fall to zero at the distance of the fifth receiver, so that receivers change without
// a step. In 1/255; the nearest receiver absorbs the rounding error.
std::array<uint8_t, 4> WeighNearest(const std::array<Near, 5>& nearest) {
  const float reach = std::max(nearest[4].distance, 1e-6f);
  std::array<float, 4> weights = {};
  float sum = 0.0f;
  for (size_t i = 0; i < 4; ++i) {
    if (nearest[i].distance < std::numeric_limits<float>::max()) {
      const float left = std::max(1.0f - nearest[i].distance / reach, 0.0f);
      weights[i] = left * left + (i == 0 ? 1e-6f : 0.0f);
      sum += weights[i];
    }
  }
  std::array<uint8_t, 4> bytes = {255, 0, 0, 0};
  for (size_t i = 1; i < 4; ++i) {
    bytes[i] = static_cast<uint8_t>(255.0f * weights[i] / sum);
    bytes[0] = static_cast<uint8_t>(bytes[0] - bytes[i]);
  }
  return bytes;
}

void BindVertices(const std::vector<SurfaceVertex>& all,
                  const std::vector<SurfaceVertex>& chosen,
                  const human::Human* human,
                  std::span<const SurfaceMesh> rest,
                  human::LightTransfer& transfer) {
  transfer.meshes.resize(rest.size());
  for (size_t m = 0; m < rest.size(); ++m) {
    transfer.meshes[m].receivers.resize(rest[m].positions.size());
    transfer.meshes[m].weights.resize(rest[m].positions.size());
  }
  ParallelFor(all.size(), [&](size_t i) {
    const SurfaceVertex& vertex = all[i];
    const std::array<Near, 5> nearest = FindNearest(human, vertex, chosen, transfer);
    human::LightTransfer::Mesh& mesh = transfer.meshes[vertex.mesh];
    for (size_t k = 0; k < 4; ++k) {
      mesh.receivers[vertex.vertex][k] = nearest[k].receiver;
    }
    mesh.weights[vertex.vertex] = WeighNearest(nearest);
  });
}

}  // namespace

void PlaceReceivers(std::span<const SurfaceMesh> rest,
                    const human::Human& human,
                    size_t count,
                    human::LightTransfer& transfer) {
  const std::vector<SurfaceVertex> all = AllVertices(rest);
  const std::vector<SurfaceVertex> chosen = Spread(all, count);
  const VertexJoints joints = StrongestJoints(human);
  transfer.receivers.clear();
  for (const SurfaceVertex& receiver : chosen) {
    transfer.receivers.push_back({joints[receiver.mesh][receiver.vertex],
                                  receiver.position + kOffSurface * receiver.normal});
  }
  BindVertices(all, chosen, &human, rest, transfer);
}

void PlacePropReceivers(std::span<const SurfaceMesh> rest,
                        std::span<const uint32_t> parts,
                        size_t count,
                        human::LightTransfer& transfer) {
  std::vector<SurfaceVertex> all = AllVertices(rest);
  for (SurfaceVertex& vertex : all) {
    vertex.part = parts[vertex.mesh];
  }
  const std::vector<SurfaceVertex> chosen = Spread(all, count);
  transfer.receivers.clear();
  for (const SurfaceVertex& receiver : chosen) {
    transfer.receivers.push_back(
        {receiver.part, receiver.position + kOffSurface * receiver.normal});
  }
  BindVertices(all, chosen, nullptr, rest, transfer);
}

}  // namespace lararium::bake
