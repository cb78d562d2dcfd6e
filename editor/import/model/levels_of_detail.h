#pragma once

// Levels of detail for distant people and objects, and an order of triangles and vertices that
// suits graphics processors (meshoptimizer) and lets lighting stop early.

#include <vector>

#include "editor/import/model/simplify.h"
#include "shared/human/human.h"
#include "shared/stage/prop.h"

namespace lararium::import {

// Reorders the triangles for the vertex cache. Vertices keep their order.
void OrderTriangles(human::SkinnedMesh& mesh);

// Fills `mesh.coarser` (simplify.h). `covered` has an entry for each vertex or is empty;
// coarser levels omit triangles whose corners are all covered.
void AddLevelsOfDetail(human::SkinnedMesh& mesh, const std::vector<bool>& covered = {});

// Adds levels to all meshes of an object that was subdivided for its light
// (bake::BakePropTransfer). Light is stored only at vertices, so the error of a level is at
// least a share of the length of its edges.
void AddLevelsOfDetail(stage::Prop& prop);

// Reorders the vertices of every mesh and all arrays parallel to them: first the vertices of
// the coarsest level, then those that each finer level adds, each in the order of its
// triangles, and last the unused ones. A level then needs only a prefix of the vertices
// (render::MeshLevel).
void OrderVertices(human::Human& human);

}  // namespace lararium::import
