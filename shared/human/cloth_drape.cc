#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "shared/core/check.h"
#include "shared/human/cloth_data.h"

namespace lararium::human {
namespace {

void SkinVertex(const SkinnedMesh& mesh,
                uint32_t v,
                std::span<const glm::mat4> skin,
                std::span<glm::vec3> positions,
                std::span<glm::vec3> normals) {
  glm::mat4 blended(0.0f);
  for (int k = 0; k < 4; ++k) {
    blended += mesh.weights[v][k] * skin[mesh.joints[v][k]];
  }
  positions[v] = glm::vec3(blended * glm::vec4(mesh.positions[v], 1.0f));
  normals[v] = UnitOr(glm::mat3(blended) * mesh.normals[v], mesh.normals[v]);
}

}  // namespace

void DrapeMesh(const ClothModel& model,
               const ClothState& state,
               size_t cloth,
               const SkinnedMesh& mesh,
               std::span<const glm::mat4> skin,
               std::span<glm::vec3> positions,
               std::span<glm::vec3> normals) {
  CHECK(positions.size() == mesh.positions.size() && normals.size() == mesh.normals.size());
  const ClothRange& range = model.data().cloths[cloth];
  for (const uint32_t v : range.skinned_vertices) {
    SkinVertex(mesh, v, skin, positions, normals);
  }
  const std::span<const glm::vec3> x = state.particles(cloth);
  const std::span<const glm::vec3> particle_normals = state.normals(cloth);
  for (const ClothVertex& vertex : range.vertices) {
    const glm::vec3& a = x[vertex.corners[0]];
    const glm::vec3& b = x[vertex.corners[1]];
    const glm::vec3& c = x[vertex.corners[2]];
    const glm::vec3 mean = vertex.weights.x * particle_normals[vertex.corners[0]] +
                           vertex.weights.y * particle_normals[vertex.corners[1]] +
                           vertex.weights.z * particle_normals[vertex.corners[2]];
    const glm::vec3 flat = UnitOr(glm::cross(b - a, c - a), mean);
    positions[vertex.vertex] =
        vertex.weights.x * a + vertex.weights.y * b + vertex.weights.z * c + vertex.offset * flat;
    normals[vertex.vertex] =
        UnitOr(ClothFrame(mean, b - a) * vertex.normal, mesh.normals[vertex.vertex]);
  }
}

}  // namespace lararium::human
