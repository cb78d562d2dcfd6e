#pragma once

// Which way a hand lies, from its joints at rest.

#include <glm/vec3.hpp>

#include "shared/human/body.h"

namespace lararium::human {

// Unit, at right angles, actor frame, rest pose.
struct Palm {
  glm::vec3 along = glm::vec3(0.0f);  // from the wrist to the knuckles
  glm::vec3 back = glm::vec3(0.0f);   // out of the back of the hand
  glm::vec3 thumb = glm::vec3(0.0f);  // across, towards the thumb's side
  float length = 0.0f;                // metres from wrist to knuckles
};

Palm FindPalm(const Body& body, int side);

}  // namespace lararium::human
