#include "shared/human/soft_parts.h"

#include <algorithm>
#include <cmath>

#include "shared/human/finite.h"
#include "shared/human/human.h"

namespace lararium::human {
namespace {

bool IsNotNegative(float value) { return std::isfinite(value) && value >= 0.0f; }

bool AllBelow(const std::vector<uint32_t>& indices, size_t count) {
  return std::all_of(indices.begin(), indices.end(), [count](uint32_t i) { return i < count; });
}

bool IsInfluence(const std::array<uint8_t, 4>& joints, const glm::vec4& w, size_t joint_count) {
  const bool exist = std::all_of(joints.begin(), joints.end(),
                                 [joint_count](uint8_t joint) { return joint < joint_count; });
  return exist && Finite(w) && std::min({w.x, w.y, w.z, w.w}) >= 0.0f &&
         std::abs(w.x + w.y + w.z + w.w - 1.0f) < 1e-3f;
}

Status ValidateParticles(const Cloth& cloth, size_t joint_count, const std::string& at) {
  const size_t count = cloth.positions.size();
  if (cloth.joints.size() != count || cloth.weights.size() != count ||
      cloth.reach.size() != count) {
    return Status::Error(at, "its particle arrays differ in length");
  }
  for (size_t i = 0; i < count; ++i) {
    if (!Finite(cloth.positions[i]) || !IsNotNegative(cloth.reach[i]) ||
        !IsInfluence(cloth.joints[i], cloth.weights[i], joint_count)) {
      return Status::Error(at, "a particle has an invalid position, reach or skin weight");
    }
  }
  if (cloth.triangles.size() % 3 != 0 || !AllBelow(cloth.triangles, count)) {
    return Status::Error(at, "its triangles name particles that do not exist");
  }
  return Status();
}

Status ValidateBinding(const Cloth& cloth, size_t vertex_count, const std::string& at) {
  if (cloth.vertex_triangle.size() != vertex_count || cloth.vertex_weights.size() != vertex_count) {
    return Status::Error(at, "does not bind each vertex of the part that follows it");
  }
  for (size_t v = 0; v < vertex_count; ++v) {
    const uint32_t triangle = cloth.vertex_triangle[v];
    if ((triangle != Cloth::kUnbound && triangle >= cloth.triangles.size() / 3) ||
        !Finite(cloth.vertex_weights[v])) {
      return Status::Error(at, "binds a vertex to a triangle that does not exist");
    }
  }
  return Status();
}

}  // namespace

Status BodyCapsule::Validate(size_t joint_count, const std::string& where) const {
  if (joint >= joint_count || !Finite(a) || !Finite(b) || !IsNotNegative(radius_a) ||
      !IsNotNegative(radius_b)) {
    return Status::Error(where, "a capsule of the body has no joint or an invalid size");
  }
  return Status();
}

Status Cloth::Validate(const std::vector<SkinnedMesh>& meshes,
                       size_t joint_count,
                       const std::string& where) const {
  const std::string at = where + ": cloth '" + name + "'";
  if (mesh >= meshes.size()) {
    return Status::Error(at, "names a part that does not exist");
  }
  LARARIUM_RETURN_IF_ERROR(ValidateParticles(*this, joint_count, at));
  LARARIUM_RETURN_IF_ERROR(ValidateBinding(*this, meshes[mesh].positions.size(), at));
  if (!(density > 0.0f) || !std::isfinite(density) || !IsNotNegative(stretch_compliance) ||
      !IsNotNegative(bend_compliance) || !IsNotNegative(friction) || !IsNotNegative(thickness)) {
    return Status::Error(at, "its material values are not valid");
  }
  return Status();
}

Status SpringChain::Validate(const std::vector<int16_t>& parents, const std::string& where) const {
  const std::string at = where + ": spring chain '" + name + "'";
  for (size_t i = 0; i < joints.size(); ++i) {
    if (joints[i] >= parents.size() ||
        (i > 0 && parents[joints[i]] != static_cast<int64_t>(joints[i - 1]))) {
      return Status::Error(at, "its joints do not exist or do not form a chain");
    }
  }
  if (!IsNotNegative(stiffness) || !IsNotNegative(drag) || !std::isfinite(gravity) ||
      !IsNotNegative(radius)) {
    return Status::Error(at, "its numbers are not valid");
  }
  return Status();
}

}  // namespace lararium::human
