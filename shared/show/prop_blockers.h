#pragma once

// Spheres that represent an object where it blocks light from people and real surfaces.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/stage/prop.h"

namespace lararium::show {

struct PropBlocker {
  uint32_t part = 0;                   // Index into Prop::parts.
  glm::vec3 centre = glm::vec3(0.0f);  // Part frame, metres.
  float radius = 0.0f;
};

// For each part with meshes, cuts its bounding box into roughly cubic pieces and puts a sphere into
// each piece, with the share of its volume that objects typically fill.
std::vector<PropBlocker> FindBlockers(const stage::Prop& prop);

}  // namespace lararium::show
