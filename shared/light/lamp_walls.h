#pragma once

// What of the real place stands in a lamp's light. A lamp looks about itself once: for each
// direction the plane of the first wall is kept, and what lies behind that plane is in its shadow.
// Planes instead of distances, because what lies on a wall that the light only grazes is not
// behind it. Stage axes, metres.

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lararium::light {

struct LampWalls {
  // Texels along a side of an octahedral map (octahedral.h) whose outermost texels lie on the
  // square's border, where it folds. Shadows are softer than a flame's for that: 4 degrees.
  static constexpr int kSize = 48;
  static constexpr size_t kTexels = size_t{kSize} * kSize;
  // What is no farther behind a plane is on it.
  static constexpr float kOnWall = 0.03f;

  // [row][column]: the plane's unit normal away from the lamp, and its distance from the origin
  // along it. Without a wall: zeros.
  std::array<glm::vec4, kTexels> planes = {};

  // The direction that a texel looks in.
  static glm::vec3 Direction(int column, int row);
};

// The share of a lamp's light that comes past the walls to a point.
float PastWalls(const LampWalls& walls, const glm::vec3& lamp, const glm::vec3& point);

}  // namespace lararium::light
