#pragma once

// Chooses the points of a person or an object at which the light left by blockers is computed.

#include <cstddef>
#include <cstdint>
#include <span>

#include "editor/bake/blockers.h"
#include "editor/bake/posed_surface.h"
#include "shared/human/light_transfer.h"

namespace lararium::bake {

// Places at most `count` receivers by farthest-point sampling in position and normal (so that
// both sides of a sheet have their own), each slightly above the surface. Then binds each
// vertex to the nearest receiver and prefers receivers with the same joints and side. `rest`
// holds the meshes of the human in the bind pose.
void PlaceReceivers(std::span<const SurfaceMesh> rest,
                    const human::Human& human,
                    size_t count,
                    human::LightTransfer& transfer);

// Does the same for the meshes of a prop at rest. `parts` holds the part of each mesh; a vertex
// uses only receivers of its own part.
void PlacePropReceivers(std::span<const SurfaceMesh> rest,
                        std::span<const uint32_t> parts,
                        size_t count,
                        human::LightTransfer& transfer);

}  // namespace lararium::bake
