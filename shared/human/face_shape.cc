#include "shared/human/face_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shared/human/finite.h"
#include "shared/human/human.h"

namespace lararium::human {
namespace {

bool AllFinite(const std::vector<glm::vec3>& values) {
  return std::all_of(values.begin(), values.end(), [](const glm::vec3& v) { return Finite(v); });
}

bool IsAscending(const std::vector<uint32_t>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
}

}  // namespace

Status MorphTarget::Validate(const std::vector<SkinnedMesh>& meshes,
                             const std::string& where) const {
  const std::string at = where + ": morph target '" + name + "'";
  std::vector<bool> seen(meshes.size(), false);
  for (const Part& part : parts) {
    if (part.mesh >= meshes.size() || seen[part.mesh]) {
      return Status::Error(at, "names a part that does not exist, or names one twice");
    }
    seen[part.mesh] = true;
    if (part.position_deltas.size() != part.vertices.size() ||
        part.normal_deltas.size() != part.vertices.size()) {
      return Status::Error(at, "its arrays differ in length");
    }
    if (!IsAscending(part.vertices) ||
        (!part.vertices.empty() && part.vertices.back() >= meshes[part.mesh].positions.size())) {
      return Status::Error(at, "names vertices that do not exist, or out of order");
    }
    if (!AllFinite(part.position_deltas) || !AllFinite(part.normal_deltas)) {
      return Status::Error(at, "a displacement is not a number");
    }
  }
  return Status();
}

Status FaceShape::Validate(size_t morph_count, size_t joint_count, const std::string& where) const {
  const std::string at = where + ": face shape '" + name + "'";
  for (const Morph& morph : morphs) {
    if (morph.morph >= morph_count || !std::isfinite(morph.weight)) {
      return Status::Error(at,
                           "names a morph target that does not exist, or has an invalid weight");
    }
  }
  for (const Turn& turn : turns) {
    if (turn.joint >= joint_count || !(std::abs(glm::length(turn.rotation) - 1.0f) < 1e-3f)) {
      return Status::Error(at, "turns a joint that does not exist, or has an invalid rotation");
    }
  }
  return Status();
}

}  // namespace lararium::human
