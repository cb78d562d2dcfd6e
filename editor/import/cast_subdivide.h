#pragma once

// Smooth surfaces from coarse ones: parts of the library that were modelled of few large
// triangles (wigs, beards) without the corners in their outlines.

#include <vector>

#include "editor/import/cast_parts.h"

namespace lararium::import {

// Cuts each chosen triangle in four and smooths the positions: Loop's scheme ("Smooth
// subdivision surfaces based on triangles", Master's thesis, University of Utah, 1987) with
// Warren's weights, cubic B-splines along open edges. Vertices of one source move as one;
// everything else that a vertex has is interpolated linearly. chosen: by triangle; a choice
// that ends in the middle of a surface makes an open edge there. Normals are left to be
// computed anew.
void SubdivideLoop(CastPiece& piece, const std::vector<bool>& chosen);

// Subdivides the connected surfaces whose edges are long, in the mean, at most so often and
// while the whole has no more than so many triangles.
struct SmoothingLimits {
  float edge = 0.007f;  // metres
  int levels = 3;
  size_t triangles = 24'000;
};
void SmoothSurfaces(CastPiece& piece, const SmoothingLimits& limits);

// The connected surface that each triangle belongs to, numbered from 0 in the order of the
// triangles. Vertices of one source are connected.
std::vector<uint32_t> ConnectedSurfaces(const CastPiece& piece);

}  // namespace lararium::import
