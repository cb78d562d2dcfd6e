#pragma once

#include <algorithm>

#include "shared/human/human.h"

namespace lararium::human {

// A cloth that is the mesh of this index, vertex by vertex. The first three vertices are attached
// to the body, and the others move by up to `reach` metres.
inline Cloth ClothOf(const SkinnedMesh& mesh, uint32_t index, float reach) {
  Cloth cloth;
  cloth.name = "cloth";
  cloth.mesh = index;
  cloth.positions = mesh.positions;
  cloth.joints = mesh.joints;
  cloth.weights = mesh.weights;
  cloth.triangles = mesh.indices;
  cloth.reach.assign(mesh.positions.size(), reach);
  std::fill_n(cloth.reach.begin(), 3, 0.0f);
  cloth.vertex_triangle.assign(mesh.positions.size(), Cloth::kUnbound);
  cloth.vertex_weights.assign(mesh.positions.size(), glm::vec3(0.0f));
  for (uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
    for (uint32_t corner = 0; corner < 3; ++corner) {
      const uint32_t vertex = mesh.indices[3 * t + corner];
      cloth.vertex_triangle[vertex] = t;
      cloth.vertex_weights[vertex] = {corner == 0 ? 1.0f : 0.0f, corner == 1 ? 1.0f : 0.0f, 0.0f};
    }
  }
  return cloth;
}

}  // namespace lararium::human
