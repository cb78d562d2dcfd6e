#include <algorithm>

#include "shared/core/check.h"
#include "shared/human/cloth_data.h"
#include "shared/human/skinning.h"

namespace lararium::human {

namespace {

Float4 Unit(const Float4& v) { return v * (1.0f / (Length(v) + 1e-20f)); }

}  // namespace

void MeasureNormals(const ClothModel::Data& model, ClothDrape& drape) {
  std::fill(drape.normals.begin(), drape.normals.end(), Float4());
  for (size_t t = 0; t < model.triangles.size(); ++t) {
    const auto [a, b, c] = model.triangles[t];
    const Float4 origin = drape.places[a];
    const Float4 normal = Cross(drape.places[b] - origin, drape.places[c] - origin);
    drape.normals[a] += normal;
    drape.normals[b] += normal;
    drape.normals[c] += normal;
    drape.triangle_normals[t] = Unit(normal);
  }
  for (Float4& normal : drape.normals) {
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
  const ClothDrape& drape = cloth_state.data().drape;
  for (const ClothVertex& vertex : range.vertices) {
    const auto [ia, ib, ic] = vertex.corners;
    const auto [wa, wb, wc] = vertex.weights;
    const Float4 a = drape.places[ia];
    const Float4 b = drape.places[ib];
    const Float4 c = drape.places[ic];
    const Float4 place =
        a * wa + b * wb + c * wc + drape.triangle_normals[vertex.triangle] * vertex.offset;
    const Float4 mean = drape.normals[ia] * wa + drape.normals[ib] * wb + drape.normals[ic] * wc;
    const Float4 normal =
        mean * vertex.normal[0] + (b - a) * vertex.normal[1] + (c - a) * vertex.normal[2];
    positions[vertex.vertex] = place.xyz();
    normals[vertex.vertex] = Unit(normal).xyz();
  }
}

}  // namespace lararium::human
