#pragma once

// Bakes the light transfer of a person (Sloan, Kautz & Snyder, SIGGRAPH 2002) with self shadows
// and interreflections, at several key poses.

#include <cstddef>

#include "shared/core/progress.h"
#include "shared/core/status.h"
#include "shared/human/human.h"
#include "shared/human/light_transfer.h"

namespace lararium::bake {

struct TransferOptions {
  int count = 16;   // coefficients: 9, 16, 25 or 36
  int rays = 256;   // Rays from each vertex at each key pose.
  int bounces = 2;  // Reflections between surfaces; 0 gives shadowed direct light only.
  size_t key_poses = 7;
  size_t blockers = 56;
  size_t receivers = 240;
};

// Deterministic for any number of cores. The person must be valid. Fails if a texture cannot be
// decoded or the job is cancelled.
Result<human::LightTransfer> BakeTransfer(const human::Human& human,
                                          const TransferOptions& options,
                                          Progress& progress);

}  // namespace lararium::bake
