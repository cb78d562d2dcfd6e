#pragma once

// Adds vertices for storing light to models with few large triangles.

#include "shared/stage/prop.h"

namespace lararium::bake {

// Splits edges in half until none is longer than `longest_edge` (metres). If that would need
// more than `most_vertices`, the mesh stays as it is. New vertices are interpolated, so that
// the surface and its look do not change. Neighbours split a shared edge in the same way, so no
// gaps appear.
void RefineMesh(float longest_edge, size_t most_vertices, stage::PropMesh& mesh);

}  // namespace lararium::bake
