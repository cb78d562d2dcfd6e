#pragma once

// Shadows of the real place in a lamp's light. The surroundings of a lamp are sampled once: each
// direction keeps the plane of the first wall, and points behind that plane are in shadow. Planes
// are stored instead of distances, because a point on a wall that the light only grazes must not
// count as behind it. Stage axes, metres.

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lararium::light {

struct LampWalls {
  // Texels along a side of an octahedral map (octahedral.h) whose outermost texels lie on the
  // square's border, where it folds. The resolution of 4 degrees makes shadows softer than those of
  // a flame.
  static constexpr int kSize = 48;
  static constexpr size_t kTexels = size_t{kSize} * kSize;
  // Points that are no further behind a plane than this are on it.
  static constexpr float kOnWall = 0.03f;

  // [row][column]: the plane's unit normal away from the lamp, and its distance from the origin
  // along the normal. Zeros if there is no wall.
  std::array<glm::vec4, kTexels> planes = {};

  // Returns the direction of a texel.
  static glm::vec3 Direction(int column, int row);
};

// Returns the share of a lamp's light that passes the walls to a point.
float PastWalls(const LampWalls& walls, const glm::vec3& lamp, const glm::vec3& point);

}  // namespace lararium::light
