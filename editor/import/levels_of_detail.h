#pragma once

// Fewer triangles for people and things that are far away, and an order of triangles and vertices
// that graphics processors like (meshoptimizer) and that lighting can stop early in.

#include <vector>

#include "editor/import/simplify.h"
#include "shared/human/human.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// Puts triangles into an order that finds its vertices in the cache. Vertices stay.
void OrderTriangles(human::SkinnedMesh& mesh);

// Fills mesh.coarser (simplify.h).
// covered: of each vertex, or empty; levels go without the triangles whose corners all are.
void AddLevelsOfDetail(human::SkinnedMesh& mesh, const std::vector<bool>& covered = {});

// Likewise of all meshes of a thing that was divided for its light (bake::BakePropTransfer). Light
// is known at vertices only, so a level counts as off by a share of its edges at least.
void AddLevelsOfDetail(stage::Prop& prop);

// Renumbers the vertices of every mesh, and all that counts them: those that the coarsest
// level takes come first, then those that the next finer one adds, and so on, each in the
// order of its triangles; last what no triangle takes. A level then needs the first so many
// only (render::MeshLevel).
void OrderVertices(human::Human& human);

}  // namespace lararium::import
