#pragma once

// The parts of a scene as skinned meshes.

#include <span>
#include <vector>

#include "editor/import/model_parts.h"
#include "editor/import/model_skeleton.h"
#include "editor/import/model_surfaces.h"
#include "shared/human/human.h"

namespace lararium::import {

// Of each part one mesh, in the actor frame. What a file gets wrong about a vertex's colour,
// direction or place on a texture is left out.
std::vector<human::SkinnedMesh> BuildMeshes(std::span<const Part> parts,
                                            const ModelSkeleton& skeleton,
                                            const ModelSurfaces& surfaces);

}  // namespace lararium::import
