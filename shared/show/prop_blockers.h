#pragma once

// Balls that stand for a thing where it keeps light off people and real surfaces.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/stage/prop.h"

namespace lararium::show {

struct PropBlocker {
  uint32_t part = 0;                   // index into Prop::parts
  glm::vec3 centre = glm::vec3(0.0f);  // part frame, metres
  float radius = 0.0f;
};

// For each part with meshes its box, cut into pieces about as long as they are wide, and
// a ball of as much of each piece's volume as things tend to fill.
std::vector<PropBlocker> FindBlockers(const stage::Prop& prop);

}  // namespace lararium::show
