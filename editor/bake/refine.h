#pragma once

// Vertices where light is to be kept: a model of few large triangles has too few.

#include "shared/stage/prop.h"

namespace lararium::bake {

// Halves edges until none is longer (metres); at most so many vertices come of it, and where
// more would be needed the mesh stays as it is. What lies between two vertices is
// interpolated, so that the surface and its look do not change. Neighbours halve a shared edge
// alike: no gaps come of it.
void RefineMesh(float longest_edge, size_t most_vertices, stage::PropMesh& mesh);

}  // namespace lararium::bake
