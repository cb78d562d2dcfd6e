#pragma once

// Fewer triangles for people who are far away, and an order of triangles and vertices
// that graphics processors like (meshoptimizer).

#include "shared/human/human.h"

namespace lararium::import {

// Puts triangles into an order that finds its vertices in the cache. Vertices stay.
void OrderTriangles(human::SkinnedMesh& mesh);

// Fills mesh.coarser with up to three levels of about a half, a quarter and an eighth of
// the triangles, by edge collapses that keep texture seams and open borders together
// (quadric error; Garland & Heckbert, SIGGRAPH 1997). A level that saves little over the
// one before is left out.
void AddLevelsOfDetail(human::SkinnedMesh& mesh);

}  // namespace lararium::import
