#pragma once

// Smooths parts of the library that were modelled with few large triangles (wigs, beards), so
// that their outlines have no corners.

#include <vector>

#include "editor/import/cast/cast_parts.h"

namespace lararium::import {

// Splits each chosen triangle in four and smooths the positions: Loop's scheme ("Smooth
// subdivision surfaces based on triangles", Master's thesis, University of Utah, 1987) with
// Warren's weights, cubic B-splines along open edges. Vertices with the same source move
// together; all other attributes are interpolated linearly. `chosen` has an entry for each
// triangle; its border inside a surface is treated as an open edge. Normals must be recomputed
// afterwards.
void SubdivideLoop(CastPiece& piece, const std::vector<bool>& chosen);

// Subdivides the connected surfaces whose mean edge length is above `edge`, at most `levels`
// times and until the piece has `triangles` triangles.
struct SmoothingLimits {
  float edge = 0.007f;  // metres
  int levels = 3;
  size_t triangles = 24'000;
};
void SmoothSurfaces(CastPiece& piece, const SmoothingLimits& limits);

// The connected surface of each triangle, numbered from 0 in the order of the triangles.
// Vertices with the same source are connected.
std::vector<uint32_t> ConnectedSurfaces(const CastPiece& piece);

}  // namespace lararium::import
