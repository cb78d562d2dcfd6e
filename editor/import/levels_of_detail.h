#pragma once

// Fewer triangles for people who are far away, and an order of triangles and vertices
// that graphics processors like (meshoptimizer) and that lighting can stop early in.

#include "shared/human/human.h"

namespace lararium::import {

// Puts triangles into an order that finds its vertices in the cache. Vertices stay.
void OrderTriangles(human::SkinnedMesh& mesh);

// Coarser than the mesh itself; files that were made with another number are made anew.
inline constexpr int kLevelsOfDetail = 4;

// Fills mesh.coarser (human/simplify.h).
// covered: of each vertex, or empty; levels go without the triangles whose corners all are.
void AddLevelsOfDetail(human::SkinnedMesh& mesh, const std::vector<bool>& covered = {});

// Renumbers the vertices of every mesh, and all that counts them: those that the coarsest
// level takes come first, then those that the next finer one adds, and so on, each in the
// order of its triangles; last what no triangle takes. A level then needs the first so many
// only (render::MeshLevel).
void OrderVertices(human::Human& human);

}  // namespace lararium::import
