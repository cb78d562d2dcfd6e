#include "shared/human/morph.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/core/check.h"

namespace lararium::human {
namespace {

// Below this weight a displacement of a centimetre moves a vertex by less than a micrometre.
constexpr float kLeastWeight = 1e-4f;

bool Counts(float weight) { return std::abs(weight) >= kLeastWeight; }

void Accumulate(const MorphTarget::Part& part, float weight, const MorphJob& job) {
  for (size_t i = 0; i < part.vertices.size(); ++i) {
    const uint32_t vertex = part.vertices[i];
    job.positions[vertex] += weight * part.position_deltas[i];
    job.normals[vertex] += weight * part.normal_deltas[i];
  }
}

void Normalize(const MorphTarget::Part& part, const MorphJob& job) {
  for (const uint32_t vertex : part.vertices) {
    glm::vec3& normal = job.normals[vertex];
    const float square = glm::dot(normal, normal);
    normal = square > 1e-12f ? normal / std::sqrt(square) : job.mesh.normals[vertex];
  }
}

}  // namespace

bool MeshMorphs::Active(std::span<const float> weights) const {
  return std::any_of(entries.begin(), entries.end(),
                     [&](const Entry& entry) { return Counts(weights[entry.morph]); });
}

std::vector<MeshMorphs> FindMeshMorphs(const Human& human) {
  std::vector<MeshMorphs> all(human.meshes.size());
  for (uint32_t mesh = 0; mesh < all.size(); ++mesh) {
    all[mesh].mesh = mesh;
  }
  for (uint32_t morph = 0; morph < human.morphs.size(); ++morph) {
    for (const MorphTarget::Part& part : human.morphs[morph].parts) {
      all[part.mesh].entries.push_back({morph, &part});
    }
  }
  std::erase_if(all, [](const MeshMorphs& mesh) { return mesh.entries.empty(); });
  return all;
}

void MorphJob::Run() const {
  CHECK(positions.size() == mesh.positions.size() && normals.size() == mesh.normals.size());
  std::copy(mesh.positions.begin(), mesh.positions.end(), positions.begin());
  std::copy(mesh.normals.begin(), mesh.normals.end(), normals.begin());
  for (const MeshMorphs::Entry& entry : morphs.entries) {
    if (Counts(weights[entry.morph])) {
      Accumulate(*entry.part, weights[entry.morph], *this);
    }
  }
  for (const MeshMorphs::Entry& entry : morphs.entries) {
    if (Counts(weights[entry.morph])) {
      Normalize(*entry.part, *this);
    }
  }
}

}  // namespace lararium::human
