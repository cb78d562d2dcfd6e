#pragma once

// From quads and triangles over base vertices to the meshes that are drawn.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "editor/import/cast_body.h"
#include "editor/import/cast_library.h"
#include "shared/human/human.h"

namespace lararium::import {

// A mesh of a person and the base vertices that each of its vertices follows.
struct CastPiece {
  human::SkinnedMesh mesh;
  // Parallel to the mesh's vertices: the vertex before doubling at texture seams, and
  // what it sits on (all on one where it is a base vertex itself).
  std::vector<uint32_t> source;
  std::vector<std::array<uint32_t, 3>> base;
  std::vector<glm::vec3> base_weights;
  // Likewise, or empty: what coarser levels of detail leave out.
  std::vector<bool> covered;
};

// The body as it is drawn: the faces of the group "body".
CastPiece SkinPiece(const CastLibrary& library, const BaseShape& shape);

// A fitted part. material: of its faces, those to take; -1: all.
CastPiece FitPart(const CastLibrary& library, const CastProxy& proxy, const BaseShape& shape);

// Where a part's own vertices lie on a shape. unshaped: the base that its offsets were
// measured on, in metres like the shape.
std::vector<glm::vec3> FitPositions(const CastProxy& proxy,
                                    std::span<const glm::vec3> base,
                                    std::span<const glm::vec3> unshaped);

// Unit normals, smooth across vertices of the same source: weighted by the angles of
// the triangles (Thuermer & Wuethrich, Journal of Graphics Tools 3(1), 1998).
std::vector<glm::vec3> SmoothNormals(std::span<const glm::vec3> positions,
                                     std::span<const uint32_t> source,
                                     std::span<const uint32_t> indices);

// Without the triangles whose three corners are all hidden, nor vertices that none uses.
void RemoveHidden(CastPiece& piece, const std::vector<bool>& hidden);

}  // namespace lararium::import
