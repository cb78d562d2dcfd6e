#pragma once

// How much each of a place's probes counts at a position and an hour.

#include <glm/vec3.hpp>
#include <span>

#include "shared/light/probe_blend.h"

namespace lararium::light {

// The most that a place has.
inline constexpr size_t kMaxPlacedProbes = 64;

// weights, one for each probe, add up to 1. At each position linear between the probes before
// and after the hour, around midnight; between positions by inverse squared distances (Shepard
// 1968). Allocates nothing.
void ComputeProbeWeights(std::span<const PlacedProbe> probes,
                         const glm::vec3& position,
                         double hour,
                         std::span<float> weights);

}  // namespace lararium::light
