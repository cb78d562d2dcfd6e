#pragma once

// Triangulates the solids of the plain figure (plain_shapes.h) and gives each vertex its albedo
// and skin weights (plain_skin.h).

#include <vector>

#include "editor/import/cast/plain_figure.h"
#include "shared/human/human.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// The parts skin, hair, tunic, belt and sandals as closed surfaces for the skeleton of
// PlainSkeleton(). The caller applies `options.height`.
std::vector<human::SkinnedMesh> PlainMeshes(const human::Skeleton& skeleton,
                                            const PlainFigureOptions& options);

}  // namespace lararium::import
