#pragma once

// Converts the parts of a scene to skinned meshes.

#include <span>
#include <string>
#include <vector>

#include "editor/import/model/model_parts.h"
#include "editor/import/model/model_skeleton.h"
#include "editor/import/model/model_surfaces.h"
#include "shared/human/human.h"

namespace lararium::import {

// Makes one mesh in the actor frame from each part. Vertex colours, normals and texture coordinates
// that are not valid become white, upwards and 0, and `notes` gets their number.
std::vector<human::SkinnedMesh> BuildMeshes(std::span<const Part> parts,
                                            const ModelSkeleton& skeleton,
                                            const ModelSurfaces& surfaces,
                                            std::vector<std::string>& notes);

}  // namespace lararium::import
