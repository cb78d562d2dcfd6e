#include <algorithm>

#include "shared/core/check.h"
#include "shared/human/cloth_data.h"
#include "shared/human/skinning.h"

namespace lararium::human {

namespace {

Float4 Unit(const Float4& v) { return v * (1.0f / (Length(v) + 1e-20f)); }

}  // namespace

void MeasureNormals(const ClothModel::Data& model, ClothState::Data& state) {
  std::fill(state.normals.begin(), state.normals.end(), Float4());
  for (size_t t = 0; t < model.triangles.size(); ++t) {
    const auto [a, b, c] = model.triangles[t];
    const Float4 origin = state.places[a];
    const Float4 normal = Cross(state.places[b] - origin, state.places[c] - origin);
    state.normals[a] += normal;
    state.normals[b] += normal;
    state.normals[c] += normal;
    state.triangle_normals[t] = Unit(normal);
  }
  for (Float4& normal : state.normals) {
    normal = Unit(normal);
  }
}

void DrapeMesh(const ClothModel& model,
               const ClothState& cloth_state,
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
  const ClothState::Data& state = cloth_state.data();
  for (const ClothVertex& vertex : range.vertices) {
    const auto [ia, ib, ic] = vertex.corners;
    const auto [wa, wb, wc] = vertex.weights;
    const Float4 a = state.places[ia];
    const Float4 b = state.places[ib];
    const Float4 c = state.places[ic];
    const Float4 place =
        a * wa + b * wb + c * wc + state.triangle_normals[vertex.triangle] * vertex.offset;
    const Float4 mean = state.normals[ia] * wa + state.normals[ib] * wb + state.normals[ic] * wc;
    const Float4 normal =
        mean * vertex.normal[0] + (b - a) * vertex.normal[1] + (c - a) * vertex.normal[2];
    positions[vertex.vertex] = place.xyz();
    normals[vertex.vertex] = Unit(normal).xyz();
  }
}

}  // namespace lararium::human
