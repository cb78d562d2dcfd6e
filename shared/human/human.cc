#include "shared/human/human.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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

// True if each mesh is moved by at most one cloth.
bool EachHasItsMesh(const std::vector<Cloth>& cloths) {
  for (size_t i = 0; i < cloths.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      if (cloths[i].mesh == cloths[k].mesh) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace

Surface SkinnedMesh::SurfaceIn(std::span<const Material> materials) const {
  return material >= 0 && size_t(material) < materials.size() ? materials[size_t(material)].surface
                                                              : Surface::kPlain;
}

Status SkinnedMesh::Validate(size_t joint_count,
                             size_t material_count,
                             const std::string& where) const {
  const std::string part = where + ": part '" + name + "'";
  const size_t count = positions.size();
  if (normals.size() != count || albedo.size() != count || joints.size() != count ||
      weights.size() != count || (!uvs.empty() && uvs.size() != count)) {
    return Status::Error(part, "its vertex arrays differ in length");
  }
  LARARIUM_RETURN_IF_ERROR(ValidateTriangles(indices, coarser, count, part));
  if (!std::isfinite(error) || error < 0.0f) {
    return Status::Error(part, "a level of detail has an invalid error value");
  }
  if (material != Material::kNone && (material < 0 || size_t(material) >= material_count)) {
    return Status::Error(part, "names a material that does not exist");
  }
  if (!std::all_of(positions.begin(), positions.end(),
                   [](const glm::vec3& p) { return Finite(p); }) ||
      !std::all_of(normals.begin(), normals.end(), IsUnit) ||
      !std::all_of(uvs.begin(), uvs.end(), [](const glm::vec2& uv) { return Finite(uv); })) {
    return Status::Error(part, "a position, normal or texture coordinate is not valid");
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

Status Human::Validate(const std::string& where) const {
  LARARIUM_RETURN_IF_ERROR(skeleton.Validate(where));
  if (skinning != Skinning::kLinear && skinning != Skinning::kDualQuaternion) {
    return Status::Error(where, "its kind of skinning is unknown");
  }
  for (const std::shared_ptr<const Texture>& texture : textures) {
    LARARIUM_RETURN_IF_ERROR(texture->Validate(where));
  }
  for (const Material& material : materials) {
    LARARIUM_RETURN_IF_ERROR(material.Validate(textures.size(), where));
  }
  for (const SkinnedMesh& mesh : meshes) {
    LARARIUM_RETURN_IF_ERROR(mesh.Validate(skeleton.size(), materials.size(), where));
  }
  for (const MorphTarget& morph : morphs) {
    LARARIUM_RETURN_IF_ERROR(morph.Validate(meshes, where));
  }
  for (const FaceShape& shape : face) {
    LARARIUM_RETURN_IF_ERROR(shape.Validate(morphs.size(), skeleton.size(), where));
  }
  if (!EachHasItsMesh(cloths)) {
    return Status::Error(where, "two cloths move the same part");
  }
  for (const Cloth& cloth : cloths) {
    LARARIUM_RETURN_IF_ERROR(cloth.Validate(meshes, skeleton.size(), where));
  }
  for (const SpringChain& spring : springs) {
    LARARIUM_RETURN_IF_ERROR(spring.Validate(skeleton.parents, where));
  }
  for (const BodyCapsule& capsule : capsules) {
    LARARIUM_RETURN_IF_ERROR(capsule.Validate(skeleton.size(), where));
  }
  LARARIUM_RETURN_IF_ERROR(light.Validate(meshes, skeleton.size(), where));
  for (const Clip& clip : clips) {
    LARARIUM_RETURN_IF_ERROR(clip.Validate(skeleton.size(), where));
  }
  return Status();
}

}  // namespace lararium::human
