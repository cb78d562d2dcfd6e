#pragma once

// Bakes the light transfer of an object or of a restored part of a building. These are static
// except for parts that move or disappear when they are used.

#include <cstddef>

#include "shared/core/status.h"
#include "shared/stage/object_use.h"

namespace lararium::bake {

struct PropTransferOptions {
  int count = 16;   // coefficients: 9, 16, 25 or 36
  int rays = 256;   // Rays from each vertex at each key pose.
  int bounces = 2;  // Reflections between surfaces; 0 gives shadowed direct light only.
  // Metres. Longer edges are split, because light is stored at vertices.
  float longest_edge = 0.1f;
  size_t most_vertices = 20'000;  // Limit of vertices for each mesh after splitting.
  float receiver_area = 0.04f;    // Square metres for each receiver.
  size_t most_receivers = 64;
};

// Gives the prop with light and with the vertices added for it. The key poses are: each
// combination of parts that a state shows, with everything else at rest; then each joint at its
// limit that is farther from rest. Deterministic for any number of cores. Fails if a texture
// cannot be decoded.
Result<stage::Prop> BakePropTransfer(const stage::ObjectModel& model,
                                     const PropTransferOptions& options);

}  // namespace lararium::bake
