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

// Real and dual part, each x, y, z, w, and the scale.
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

float DotOfReal(Columns a, Columns b) {
  const Columns product = a * b;
  return product[0] + product[1] + product[2] + product[3];
}

void SkinByDualQuaternions(const SkinningJob& job) {
  std::array<PackedDualQuaternion, Skeleton::kMaxJoints> packed;
  CHECK(job.skin.size() <= packed.size());
  std::transform(job.skin.begin(), job.skin.end(), packed.begin(), Pack);
  for (size_t v = 0; v < job.bind_positions.size(); ++v) {
    const PackedDualQuaternion& pivot = packed[job.joints[v][0]];
    Columns blend = job.weights[v][0] * pivot.parts;
    float scale = job.weights[v][0] * pivot.scale;
    for (int k = 1; k < 4; ++k) {
      const PackedDualQuaternion& other = packed[job.joints[v][k]];
      const float weight = job.weights[v][k];
      blend += std::copysign(weight, DotOfReal(pivot.parts, other.parts)) * other.parts;
      scale += weight * other.scale;
    }
    const float square = DotOfReal(blend, blend);
    blend = square > 1e-12f ? blend * (1.0f / std::sqrt(square)) : pivot.parts;
    const glm::vec3 r(blend[0], blend[1], blend[2]);
    const glm::vec3 d(blend[4], blend[5], blend[6]);
    const float rw = blend[3];
    const float dw = blend[7];
    const auto rotate = [&](const glm::vec3& x) {
      return x + 2.0f * glm::cross(r, glm::cross(r, x) + rw * x);
    };
    job.positions[v] =
        rotate(scale * job.bind_positions[v]) + 2.0f * (rw * d - dw * r + glm::cross(r, d));
    job.normals[v] = rotate(job.bind_normals[v]);
  }
}

}  // namespace

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
