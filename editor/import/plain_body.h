#pragma once

// The meshes of the plain figure: its solids (plain_shapes.h) triangulated, with albedo and
// skin weights (plain_skin.h) for every vertex.

#include <vector>

#include "editor/import/plain_figure.h"
#include "shared/human/human.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// Parts skin, hair, tunic, belt, sandals, all of closed surfaces, for the
// skeleton of PlainSkeleton(). options.height is left to the caller.
std::vector<human::SkinnedMesh> PlainMeshes(const human::Skeleton& skeleton,
                                            const PlainFigureOptions& options);

}  // namespace lararium::import
