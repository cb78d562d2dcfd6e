#pragma once

// The colour of a light as people set it.

#include <glm/vec3.hpp>

namespace lararium::app {

// A balance of channels as people think of it. Both in stops: warmth is red over blue, tint
// green over the two.
struct WhiteBalance {
  double warmth = 0.0;
  double tint = 0.0;
};
// The product of the channels is 1.
glm::vec3 BalanceOf(const WhiteBalance& white);
WhiteBalance WhiteBalanceOf(const glm::vec3& balance);

}  // namespace lararium::app
