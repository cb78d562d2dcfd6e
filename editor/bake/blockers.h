#pragma once

// Fits the spheres that stand for a person or an object when it blocks light.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/bake/posed_surface.h"
#include "shared/core/status.h"
#include "shared/human/light_transfer.h"

namespace lararium::bake {

// Index of the joint or part that each vertex follows.
using VertexJoints = std::vector<std::vector<uint16_t>>;  // [mesh][vertex]
VertexJoints StrongestJoints(const human::Human& human);

// Fits at most `count` spheres to everything that lies inside the surfaces at rest, or that
// they enclose (the space under a tunic). Samples a grid, keeps the points from which almost no
// ray escapes, and groups them with k-means into clusters that each follow one joint; the
// sphere of a cluster has its volume. After the sphere sets of Ren et al., "Real-time Soft
// Shadows in Dynamic Scenes using Spherical Harmonic Exponentiation", SIGGRAPH 2006. The result
// is empty if nothing is enclosed.
Result<std::vector<human::LightTransfer::Blocker>> FitBlockers(std::span<const SurfaceMesh> rest,
                                                               const VertexJoints& joints,
                                                               size_t count);

}  // namespace lararium::bake
