#include "editor/import/cast/cast_mouth.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace lararium::import {
namespace {

// Shares of the light on the face that reach the front teeth, the tip of the tongue, the inner
// sides of the lips, and the throat.
constexpr float kTeeth = 0.65f;
constexpr float kTongue = 0.3f;
constexpr float kLining = 0.45f;
constexpr float kThroat = 0.015f;

// The extent of the mouth, derived from the teeth.
struct Mouth {
  glm::vec3 low{1e9f};
  glm::vec3 high{-1e9f};

  explicit Mouth(const human::SkinnedMesh& teeth) {
    for (const glm::vec3& p : teeth.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  float depth() const { return high.z - low.z; }
  // Depth behind the front teeth (at the least z: people face -Z), from 0 to 1 at the last
  // ones.
  float Behind(const glm::vec3& p) const { return (p.z - low.z) / depth(); }
  glm::vec3 middle() const {
    return {0.5f * (low.x + high.x), 0.5f * (low.y + high.y), low.z + 0.45f * depth()};
  }
  // Says whether a point of the skin lines the mouth: near the teeth, and facing inward.
  bool Lines(const glm::vec3& p, const glm::vec3& normal) const {
    const glm::vec3 margin(0.004f, 0.012f, 0.006f);
    const glm::vec3 past(0.0f, 0.0f, 0.03f);
    return glm::all(glm::greaterThan(p, low - margin)) &&
           glm::all(glm::lessThan(p, high + margin + past)) &&
           glm::dot(normal, middle() - p) > 0.0f;
  }
};

float Reaches(float in_front, float behind) {
  return glm::mix(in_front, kThroat, glm::smoothstep(0.0f, 0.75f, behind));
}

}  // namespace

void ShadeMouth(std::span<CastPiece> pieces, const std::string& teeth, const std::string& tongue) {
  const auto bite = std::find_if(pieces.begin(), pieces.end(), [&teeth](const CastPiece& piece) {
    return piece.mesh.name == teeth && !piece.mesh.positions.empty();
  });
  if (bite == pieces.end()) {
    return;
  }
  const Mouth mouth(bite->mesh);
  if (!(mouth.depth() > 1e-4f)) {
    return;
  }
  for (CastPiece& piece : pieces) {
    human::SkinnedMesh& mesh = piece.mesh;
    const bool is_skin = &piece == &pieces.front();
    const float in_front = mesh.name == teeth ? kTeeth : mesh.name == tongue ? kTongue : kLining;
    if (!is_skin && mesh.name != teeth && mesh.name != tongue) {
      continue;
    }
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
      if (!is_skin || mouth.Lines(mesh.positions[v], mesh.normals[v])) {
        mesh.albedo[v] *= Reaches(in_front, mouth.Behind(mesh.positions[v]));
      }
    }
  }
}

}  // namespace lararium::import
