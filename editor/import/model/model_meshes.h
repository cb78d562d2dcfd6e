#pragma once

// Converts the parts of a scene to skinned meshes.

#include <span>
#include <vector>

#include "editor/import/model/model_parts.h"
#include "editor/import/model/model_skeleton.h"
#include "editor/import/model/model_surfaces.h"
#include "shared/human/human.h"

namespace lararium::import {

// Makes one mesh in the actor frame from each part. Invalid vertex colours, normals and texture
// coordinates are left out.
std::vector<human::SkinnedMesh> BuildMeshes(std::span<const Part> parts,
                                            const ModelSkeleton& skeleton,
                                            const ModelSurfaces& surfaces);

}  // namespace lararium::import
