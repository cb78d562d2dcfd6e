#pragma once

// The octahedral map of all directions onto a square, about +Y (Engelhardt & Dachsbacher,
// "Octahedron Environment Maps", VMV 2008), as in shaders/include/octahedral.glsl. The inner
// diamond is the upper half.

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

// Inverse of OctahedralDirection(); the length of `direction` may be anything but zero.
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
