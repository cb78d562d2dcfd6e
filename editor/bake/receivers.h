#pragma once

// Chooses where on a person or a thing the light left by blockers is worked out.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "editor/bake/blockers.h"
#include "editor/bake/posed_surface.h"
#include "shared/human/light_transfer.h"

namespace lararium::bake {

// At most count receivers, spread over the surface by farthest-point sampling in place
// and normal (so that both sides of a sheet have theirs), each a little off it.
// Then binds every vertex to the nearest of them, preferring those of its own joints and
// side. rest: the meshes of the human in the bind pose.
void PlaceReceivers(std::span<const SurfaceMesh> rest,
                    const human::Human& human,
                    size_t count,
                    human::LightTransfer& transfer);

// The same for a prop's meshes as they stand at rest, whose parts are given: each part has its
// own receivers, and no vertex takes another's.
void PlacePropReceivers(std::span<const SurfaceMesh> rest,
                        std::span<const uint32_t> parts,
                        size_t count,
                        human::LightTransfer& transfer);

}  // namespace lararium::bake
