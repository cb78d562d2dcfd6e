#include "shared/human/human.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "shared/human/finite.h"

namespace lararium::human {
namespace {

bool IsAlbedo(const glm::vec3& v) {
  return v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f && v.x <= 1.0f && v.y <= 1.0f && v.z <= 1.0f;
}

bool IsUnit(const glm::vec3& v) { return std::abs(glm::dot(v, v) - 1.0f) < 1e-2f; }

bool AreWeights(const glm::vec4& w) {
  return w.x >= 0.0f && w.y >= 0.0f && w.z >= 0.0f && w.w >= 0.0f &&
         std::abs(w.x + w.y + w.z + w.w - 1.0f) < 1e-3f;
}

}  // namespace

Status SkinnedMesh::Validate(size_t joint_count, const std::string& place) const {
  const std::string part = place + ": part '" + name + "'";
  const size_t count = positions.size();
  if (normals.size() != count || albedo.size() != count || joints.size() != count ||
      weights.size() != count) {
    return Status::Error(part, "its vertex arrays differ in length");
  }
  if (indices.size() % 3 != 0 ||
      std::any_of(indices.begin(), indices.end(), [count](uint32_t i) { return i >= count; })) {
    return Status::Error(part, "its triangles name vertices that do not exist");
  }
  if (!std::all_of(positions.begin(), positions.end(),
                   [](const glm::vec3& p) { return Finite(p); }) ||
      !std::all_of(normals.begin(), normals.end(), IsUnit)) {
    return Status::Error(part, "a position or normal is not a possible one");
  }
  if (!std::all_of(albedo.begin(), albedo.end(), IsAlbedo)) {
    return Status::Error(part, "an albedo is outside 0..1");
  }
  if (!std::all_of(weights.begin(), weights.end(), AreWeights)) {
    return Status::Error(part, "the skin weights of a vertex do not sum to 1");
  }
  for (const std::array<uint8_t, 4>& influences : joints) {
    for (const uint8_t joint : influences) {
      if (joint >= joint_count) {
        return Status::Error(part, "a skin weight names a joint that does not exist");
      }
    }
  }
  return Status();
}

Status Human::Validate(const std::string& place) const {
  LARARIUM_RETURN_IF_ERROR(skeleton.Validate(place));
  for (const SkinnedMesh& mesh : meshes) {
    LARARIUM_RETURN_IF_ERROR(mesh.Validate(skeleton.size(), place));
  }
  for (const Clip& clip : clips) {
    LARARIUM_RETURN_IF_ERROR(clip.Validate(skeleton.size(), place));
  }
  return Status();
}

void SkinMesh(const SkinnedMesh& mesh,
              std::span<const glm::mat4> skin,
              std::span<glm::vec3> positions,
              std::span<glm::vec3> normals) {
  CHECK(positions.size() == mesh.positions.size() && normals.size() == mesh.normals.size());
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    glm::mat4 blended(0.0f);
    for (int k = 0; k < 4; ++k) {
      blended += mesh.weights[v][k] * skin[mesh.joints[v][k]];
    }
    positions[v] = glm::vec3(blended * glm::vec4(mesh.positions[v], 1.0f));
    const glm::vec3 normal = glm::mat3(blended) * mesh.normals[v];
    const float length = glm::length(normal);
    normals[v] = length > 0.0f ? normal / length : mesh.normals[v];
  }
}

}  // namespace lararium::human
