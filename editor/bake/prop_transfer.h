#pragma once

// Bakes the light transfer of a thing or a restored piece of a building: what stands still,
// but for the parts that its use moves or hides.

#include <cstddef>

#include "shared/core/status.h"
#include "shared/stage/object_use.h"

namespace lararium::bake {

struct PropTransferOptions {
  int count = 16;                 // coefficients: 9, 16, 25 or 36
  int rays = 256;                 // from each vertex at each key pose
  int bounces = 2;                // reflections between surfaces; 0: shadowed direct light alone
  float longest_edge = 0.1f;      // metres: where light is kept
  size_t most_vertices = 20'000;  // of a mesh, for the sake of that
  float receiver_area = 0.04f;    // m^2 for each receiver
  size_t most_receivers = 64;
};

// The prop with light, and with the vertices that light takes. Key poses: each choice of parts
// that a state shows, all else at rest; then each joint at the end that is farther from its
// rest. Deterministic, whatever the number of cores. Fails where a texture cannot be decoded.
Result<stage::Prop> BakePropTransfer(const stage::ObjectModel& model,
                                     const PropTransferOptions& options);

}  // namespace lararium::bake
