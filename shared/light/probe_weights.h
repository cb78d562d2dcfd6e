#pragma once

// Weights of a place's probes at a position and an hour.

#include <glm/vec3.hpp>
#include <span>

#include "shared/light/probe_blend.h"

namespace lararium::light {

// Maximum number of probes of a place.
inline constexpr size_t kMaxPlacedProbes = 64;

// Computes one weight for each probe, with the sum 1. At each position they interpolate linearly
// between the probes before and after the hour, across midnight; between positions by inverse
// squared distances (Shepard 1968). Allocates nothing.
void ComputeProbeWeights(std::span<const PlacedProbe> probes,
                         const glm::vec3& position,
                         double hour,
                         std::span<float> weights);

}  // namespace lararium::light
