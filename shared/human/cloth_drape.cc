#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "shared/core/check.h"
#include "shared/human/cloth_data.h"
#include "shared/human/skinning.h"
#include "shared/human/turns.h"

namespace lararium::human {

void DrapeMesh(const ClothModel& model,
               const ClothState& state,
               size_t cloth,
               const SkinnedMesh& mesh,
               std::span<const glm::mat4> skin,
               std::span<glm::vec3> positions,
               std::span<glm::vec3> normals) {
  CHECK(positions.size() == mesh.positions.size() && normals.size() == mesh.normals.size());
  const ClothRange& range = model.data().cloths[cloth];
  if (range.has_plain_skin) {
    SkinMesh(mesh, skin, positions, normals, model.data().skinning);
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
    const glm::vec3 flat = Direction(glm::cross(b - a, c - a), mean);
    positions[vertex.vertex] =
        vertex.weights.x * a + vertex.weights.y * b + vertex.weights.z * c + vertex.offset * flat;
    normals[vertex.vertex] =
        Direction(ClothFrame(mean, b - a) * vertex.normal, mesh.normals[vertex.vertex]);
  }
}

}  // namespace lararium::human
