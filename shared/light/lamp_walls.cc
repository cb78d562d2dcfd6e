#include "shared/light/lamp_walls.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "shared/light/octahedral.h"

namespace lararium::light {

glm::vec3 LampWalls::Direction(int column, int row) {
  return OctahedralDirection(2.0f * glm::vec2(column, row) / static_cast<float>(kSize - 1) - 1.0f);
}

float PastWalls(const LampWalls& walls, const glm::vec3& lamp, const glm::vec3& point) {
  const glm::vec3 way = point - lamp;
  if (!(glm::dot(way, way) > 1e-12f)) {
    return 1.0f;
  }
  constexpr auto kLast = static_cast<float>(LampWalls::kSize - 1);
  const glm::vec2 at = (0.5f * OctahedralPosition(way) + 0.5f) * kLast;
  const glm::vec2 low = glm::clamp(glm::floor(at), 0.0f, kLast - 1.0f);
  const glm::vec2 part = at - low;
  const auto seen = [&](size_t column, size_t row) {
    const glm::vec4& plane = walls.planes[row * LampWalls::kSize + column];
    return glm::dot(glm::vec3(plane), point) - plane.w > LampWalls::kOnWall ? 0.0f : 1.0f;
  };
  const auto column = static_cast<size_t>(low.x);
  const auto row = static_cast<size_t>(low.y);
  return std::lerp(std::lerp(seen(column, row), seen(column + 1, row), part.x),
                   std::lerp(seen(column, row + 1), seen(column + 1, row + 1), part.x), part.y);
}

}  // namespace lararium::light
