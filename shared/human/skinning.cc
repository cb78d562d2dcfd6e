#include "shared/human/skinning.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

#include "shared/core/check.h"

namespace lararium::human {
namespace {

// Two columns of a matrix, so that one instruction blends both.
using Columns = float __attribute__((vector_size(32)));
using Column = float __attribute__((vector_size(16)));

Columns Load(const float* values) {
  Columns columns;
  std::memcpy(&columns, values, sizeof(columns));
  return columns;
}

Column AddHalves(Columns columns) {
  return __builtin_shufflevector(columns, columns, 0, 1, 2, 3) +
         __builtin_shufflevector(columns, columns, 4, 5, 6, 7);
}

glm::vec3 Xyz(Column v) { return {v[0], v[1], v[2]}; }

glm::vec3 UnitOr(const glm::vec3& v, const glm::vec3& otherwise) {
  const float square = glm::dot(v, v);
  return square > 0.0f ? v * (1.0f / std::sqrt(square)) : otherwise;
}

void SkinLinearly(const SkinningJob& job) {
  const float* const skin = glm::value_ptr(job.skin[0]);
  for (size_t v = 0; v < job.bind_positions.size(); ++v) {
    const std::array<uint8_t, 4>& joints = job.joints[v];
    const glm::vec4& weights = job.weights[v];
    const float* matrix = skin + 16 * joints[0];
    Columns first = weights[0] * Load(matrix);
    Columns last = weights[0] * Load(matrix + 8);
    for (int k = 1; k < 4; ++k) {
      matrix = skin + 16 * joints[k];
      first += weights[k] * Load(matrix);
      last += weights[k] * Load(matrix + 8);
    }
    const glm::vec3& p = job.bind_positions[v];
    const glm::vec3& n = job.bind_normals[v];
    job.positions[v] = Xyz(AddHalves(first * Columns{p.x, p.x, p.x, p.x, p.y, p.y, p.y, p.y} +
                                     last * Columns{p.z, p.z, p.z, p.z, 1.0f, 1.0f, 1.0f, 1.0f}));
    const glm::vec3 normal =
        Xyz(AddHalves(first * Columns{n.x, n.x, n.x, n.x, n.y, n.y, n.y, n.y} +
                      last * Columns{n.z, n.z, n.z, n.z, 0.0f, 0.0f, 0.0f, 0.0f}));
    job.normals[v] = UnitOr(normal, n);
  }
}

// Real and dual part, each x, y, z, w.
struct PackedDualQuaternion {
  Columns parts;
  float scale;
};

PackedDualQuaternion Pack(const glm::mat4& matrix) {
  const DualQuaternion q = ToDualQuaternion(matrix);
  const Columns parts = {q.real.x, q.real.y, q.real.z, q.real.w,
                         q.dual.x, q.dual.y, q.dual.z, q.dual.w};
  return {parts, q.scale};
}

Column Real(Columns parts) { return __builtin_shufflevector(parts, parts, 0, 1, 2, 3); }
Column Dual(Columns parts) { return __builtin_shufflevector(parts, parts, 4, 5, 6, 7); }

float Dot4(Column a, Column b) {
  const Column product = a * b;
  const Column halves = product + __builtin_shufflevector(product, product, 2, 3, 0, 1);
  return halves[0] + halves[1];
}

// Cross product of the first three components; the fourth becomes 0 if all are finite.
Column Cross(Column a, Column b) {
  const Column a_yzx = __builtin_shufflevector(a, a, 1, 2, 0, 3);
  const Column b_yzx = __builtin_shufflevector(b, b, 1, 2, 0, 3);
  const Column zxy = a * b_yzx - a_yzx * b;
  return __builtin_shufflevector(zxy, zxy, 1, 2, 0, 3);
}

// Weighted sum, normalised to unit length; the scale is blended separately.
PackedDualQuaternion Blend(std::span<const PackedDualQuaternion> all,
                           const std::array<uint8_t, 4>& joints,
                           const glm::vec4& weights) {
  const PackedDualQuaternion& pivot = all[joints[0]];
  PackedDualQuaternion blend = {weights[0] * pivot.parts, weights[0] * pivot.scale};
  for (int k = 1; k < 4; ++k) {
    if (weights[k] == 0.0f) {
      continue;
    }
    const PackedDualQuaternion& other = all[joints[k]];
    const float side = Dot4(Real(pivot.parts), Real(other.parts));
    blend.parts += std::copysign(weights[k], side) * other.parts;
    blend.scale += weights[k] * other.scale;
  }
  const float square = Dot4(Real(blend.parts), Real(blend.parts));
  blend.parts = square > 1e-12f ? blend.parts * (1.0f / std::sqrt(square)) : pivot.parts;
  return blend;
}

void SkinByDualQuaternions(const SkinningJob& job) {
  std::array<PackedDualQuaternion, Skeleton::kMaxJoints> packed;
  CHECK(job.skin.size() <= packed.size());
  std::transform(job.skin.begin(), job.skin.end(), packed.begin(), Pack);
  for (size_t v = 0; v < job.bind_positions.size(); ++v) {
    const PackedDualQuaternion blend = Blend(packed, job.joints[v], job.weights[v]);
    const Column r = Real(blend.parts);
    const Column d = Dual(blend.parts);
    const auto rotate = [&](Column x) { return x + 2.0f * Cross(r, Cross(r, x) + r[3] * x); };
    const glm::vec3& p = job.bind_positions[v];
    const glm::vec3& n = job.bind_normals[v];
    const Column translation = 2.0f * (r[3] * d - d[3] * r + Cross(r, d));
    job.positions[v] = Xyz(rotate(blend.scale * Column{p.x, p.y, p.z, 0.0f}) + translation);
    job.normals[v] = Xyz(rotate(Column{n.x, n.y, n.z, 0.0f}));
  }
}

}  // namespace

std::vector<glm::mat4> SkinOfPose(const Skeleton& skeleton, std::span<const JointTransform> pose) {
  std::vector<glm::mat4> actor_from_joint(skeleton.size());
  std::vector<glm::mat4> skin(skeleton.size());
  ComputeActorFromJoint(skeleton, pose, actor_from_joint);
  ComputeSkinMatrices(skeleton, actor_from_joint, skin);
  return skin;
}

DualQuaternion ToDualQuaternion(const glm::mat4& matrix) {
  DualQuaternion q;
  const glm::mat3 linear(matrix);
  const float volume = glm::determinant(linear);
  q.scale = std::cbrt(std::max(volume, 0.0f));
  glm::vec3 x = linear[0];
  glm::vec3 y = linear[1];
  if (q.scale > 0.0f) {
    x = glm::normalize(x);
    y = glm::normalize(y - glm::dot(x, y) * x);
    q.real = glm::normalize(glm::quat_cast(glm::mat3(x, y, glm::cross(x, y))));
  }
  const glm::vec3 t(matrix[3]);
  q.dual = 0.5f * (glm::quat(0.0f, t.x, t.y, t.z) * q.real);
  return q;
}

void SkinningJob::Run() const {
  const size_t count = bind_positions.size();
  CHECK(bind_normals.size() == count && joints.size() == count && weights.size() == count);
  CHECK(positions.size() == count && normals.size() == count && !skin.empty());
  if (skinning == Skinning::kLinear) {
    SkinLinearly(*this);
  } else {
    SkinByDualQuaternions(*this);
  }
}

void SkinMesh(const SkinnedMesh& mesh,
              std::span<const glm::mat4> skin,
              std::span<glm::vec3> positions,
              std::span<glm::vec3> normals,
              Skinning skinning) {
  SkinningJob{mesh.positions, mesh.normals, mesh.joints, mesh.weights,
              skin,           skinning,     positions,   normals}
      .Run();
}

}  // namespace lararium::human
