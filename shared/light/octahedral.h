#pragma once

// All directions on a square: the octahedral map about +Y (Engelhardt & Dachsbacher, "Octahedron
// Environment Maps", VMV 2008), as shaders/include/octahedral.glsl has it. Its inner diamond is
// the upper half.

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace lararium::light {

// The unit direction of a point of the square, -1..1 on both sides.
inline glm::vec3 OctahedralDirection(const glm::vec2& at) {
  glm::vec3 direction(at.x, 1.0f - std::abs(at.x) - std::abs(at.y), at.y);
  if (direction.y < 0.0f) {
    direction.x = (1.0f - std::abs(at.y)) * std::copysign(1.0f, at.x);
    direction.z = (1.0f - std::abs(at.x)) * std::copysign(1.0f, at.y);
  }
  return glm::normalize(direction);
}

// The way back, of any length but zero.
inline glm::vec2 OctahedralPosition(const glm::vec3& direction) {
  const glm::vec3 d =
      direction / (std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z));
  if (d.y < 0.0f) {
    return {(1.0f - std::abs(d.z)) * std::copysign(1.0f, d.x),
            (1.0f - std::abs(d.x)) * std::copysign(1.0f, d.z)};
  }
  return {d.x, d.z};
}

}  // namespace lararium::light
