#include "shared/stage/prop.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/human/finite.h"

namespace lararium::stage {
namespace {

constexpr float kMaxEmission = 1e6f;

bool IsUnit(const glm::vec3& v) { return std::abs(glm::dot(v, v) - 1.0f) < 1e-2f; }

bool LiesBetween(const glm::vec3& v, float low, float high) {
  return v.x >= low && v.y >= low && v.z >= low && v.x <= high && v.y <= high && v.z <= high;
}

Status ValidatePart(const Prop& prop, size_t index, const std::string& where) {
  const PropPart& part = prop.parts[index];
  const std::string at = where + ": part '" + part.name + "'";
  if (part.name.empty()) {
    return Status::Error(where, "a part has no name");
  }
  if (prop.FindPart(part.name) != static_cast<int>(index)) {
    return Status::Error(at, "two parts have this name");
  }
  if (part.parent != PropPart::kNoParent &&
      (part.parent < 0 || static_cast<size_t>(part.parent) >= index)) {
    return Status::Error(at, "its parent must be an earlier part");
  }
  if (!human::Finite(part.parent_from_part.position) ||
      !(std::abs(glm::length(part.parent_from_part.rotation) - 1.0f) < 1e-3f)) {
    return Status::Error(at, "its place is not a rigid transform");
  }
  for (const PropMesh& mesh : part.meshes) {
    LARARIUM_RETURN_IF_ERROR(mesh.Validate(prop.materials.size(), at));
  }
  return Status();
}

Status ValidateLight(const Prop& prop, const std::string& where) {
  if (prop.light_shown.size() != prop.light.key_poses.size()) {
    return Status::Error(where, "does not say which parts are shown in the key poses of its light",
                         "bake the project again");
  }
  std::vector<human::LightTransfer::Surface> surfaces;
  for (const PropPart& part : prop.parts) {
    for (const PropMesh& mesh : part.meshes) {
      surfaces.push_back({part.name, mesh.positions.size()});
    }
  }
  return prop.light.Validate(surfaces, prop.parts.size(), where);
}

}  // namespace

Status PropMesh::Validate(size_t material_count, const std::string& where) const {
  const size_t count = positions.size();
  if (normals.size() != count || albedo.size() != count || (!uvs.empty() && uvs.size() != count)) {
    return Status::Error(where, "its vertex arrays differ in length");
  }
  LARARIUM_RETURN_IF_ERROR(human::ValidateTriangles(indices, coarser, count, where));
  if (!std::all_of(positions.begin(), positions.end(),
                   [](const glm::vec3& p) { return human::Finite(p); }) ||
      !std::all_of(normals.begin(), normals.end(), IsUnit) ||
      !std::all_of(uvs.begin(), uvs.end(), [](const glm::vec2& uv) {
        return std::isfinite(uv.x) && std::isfinite(uv.y);
      })) {
    return Status::Error(where, "a position, normal or texture coordinate is not valid");
  }
  if (!std::all_of(albedo.begin(), albedo.end(),
                   [](const glm::vec3& a) { return LiesBetween(a, 0.0f, 1.0f); })) {
    return Status::Error(where, "an albedo is outside 0..1");
  }
  if (!LiesBetween(emission, 0.0f, kMaxEmission)) {
    return Status::Error(where, "its emission is out of range");
  }
  if (material != human::Material::kNone &&
      (material < 0 || static_cast<size_t>(material) >= material_count)) {
    return Status::Error(where, "names a material that does not exist");
  }
  return Status();
}

int Prop::FindPart(std::string_view part) const {
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [part](const PropPart& p) { return p.name == part; });
  return found == parts.end() ? -1 : static_cast<int>(found - parts.begin());
}

Status Prop::Validate(const std::string& where) const {
  if (parts.empty() || parts.size() > kMaxParts) {
    return Status::Error(where, "it must have from 1 to " + std::to_string(kMaxParts) + " parts");
  }
  for (const std::shared_ptr<const human::Texture>& texture : textures) {
    LARARIUM_RETURN_IF_ERROR(texture->Validate(where));
  }
  for (const human::Material& material : materials) {
    LARARIUM_RETURN_IF_ERROR(material.Validate(textures.size(), where));
  }
  for (size_t i = 0; i < parts.size(); ++i) {
    LARARIUM_RETURN_IF_ERROR(ValidatePart(*this, i, where));
  }
  return ValidateLight(*this, where);
}

}  // namespace lararium::stage
