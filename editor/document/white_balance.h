#pragma once

// The colour of a light in the terms that the interface uses.

#include <glm/vec3.hpp>

namespace lararium::editor {

// In stops (powers of two): warmth is red over blue, tint is green over red and blue.
struct WhiteBalance {
  double warmth = 0.0;
  double tint = 0.0;
};
// Gains of red, green and blue, whose product is 1.
glm::vec3 BalanceOf(const WhiteBalance& white);
WhiteBalance WhiteBalanceOf(const glm::vec3& balance);

}  // namespace lararium::editor
