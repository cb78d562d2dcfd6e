#pragma once

// Spheres that block about the light that a person or thing blocks.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/bake/posed_surface.h"
#include "shared/core/status.h"
#include "shared/human/light_transfer.h"

namespace lararium::bake {

// What a vertex follows: index of a joint or part.
using VertexJoints = std::vector<std::vector<uint16_t>>;  // [mesh][vertex]
VertexJoints StrongestJoints(const human::Human& human);

// At most count spheres over all that is inside the surfaces at rest, or shut in by
// them (under a tunic): points of a grid from which nearly no ray gets out, in clusters
// that follow one joint each (k-means), each cluster a sphere of its volume. After the
// sphere sets of Ren et al., "Real-time Soft Shadows in Dynamic Scenes using Spherical
// Harmonic Exponentiation", SIGGRAPH 2006. Empty where nothing is shut in.
Result<std::vector<human::LightTransfer::Blocker>> FitBlockers(std::span<const SurfaceMesh> rest,
                                                               const VertexJoints& joints,
                                                               size_t count);

}  // namespace lararium::bake
