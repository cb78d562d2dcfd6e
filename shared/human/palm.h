#pragma once

// Orientation of a hand, from its joints at rest.

#include <glm/vec3.hpp>

#include "shared/human/body_rig.h"

namespace lararium::human {

// Orthogonal unit vectors in the actor frame, in the rest pose.
struct Palm {
  glm::vec3 along = glm::vec3(0.0f);  // Direction from the wrist to the knuckles.
  glm::vec3 back = glm::vec3(0.0f);   // Direction out of the back of the hand.
  glm::vec3 thumb = glm::vec3(0.0f);  // Direction across the hand, towards the thumb's side.
  float length = 0.0f;                // metres from wrist to knuckles
};

Palm FindPalm(const BodyRig& body, int side);

}  // namespace lararium::human
