#include "shared/geometry/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lararium::geometry {
namespace {

bool Finite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

float Angle(const glm::vec3& a, const glm::vec3& b) {
  const float lengths = glm::length(a) * glm::length(b);
  return lengths > 0.0f ? std::acos(std::clamp(glm::dot(a, b) / lengths, -1.0f, 1.0f)) : 0.0f;
}

}  // namespace

Status TriangleMesh::Validate(const std::string& where) const {
  if (indices.size() % 3 != 0) {
    return Status::Error(where, "the number of indices is not a multiple of three");
  }
  if (!normals.empty() && normals.size() != positions.size()) {
    return Status::Error(where, "there must be one normal for each vertex");
  }
  if (!std::all_of(positions.begin(), positions.end(), Finite) ||
      !std::all_of(normals.begin(), normals.end(), Finite)) {
    return Status::Error(where, "a vertex holds a number that is not finite");
  }
  const size_t count = positions.size();
  if (std::any_of(indices.begin(), indices.end(), [count](uint32_t i) { return i >= count; })) {
    return Status::Error(where, "an index names a vertex that does not exist");
  }
  return Status();
}

void ComputeNormals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f));
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const uint32_t* corner = &mesh.indices[i];
    const glm::vec3 p[3] = {mesh.positions[corner[0]], mesh.positions[corner[1]],
                            mesh.positions[corner[2]]};
    const glm::vec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float length = glm::length(cross);
    if (!(length > 0.0f)) {
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const float angle = Angle(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
      mesh.normals[corner[k]] += angle / length * cross;
    }
  }
  for (glm::vec3& normal : mesh.normals) {
    const float length = glm::length(normal);
    normal = length > 0.0f ? normal / length : glm::vec3(0.0f, 1.0f, 0.0f);
  }
}

}  // namespace lararium::geometry
