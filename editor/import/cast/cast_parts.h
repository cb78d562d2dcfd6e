#pragma once

// Converts quads and triangles over base vertices to drawable meshes.

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "editor/import/cast/cast_body.h"
#include "editor/import/cast/cast_library.h"
#include "shared/human/human.h"

namespace lararium::import {

// A mesh of a person, with the base vertices that each vertex follows.
struct CastPiece {
  human::SkinnedMesh mesh;
  // Parallel to the vertices of the mesh. `source` is the vertex before doubling at texture
  // seams; `base` holds the base vertices that it is attached to (all weight on one if it is a
  // base vertex itself).
  std::vector<uint32_t> source;
  std::vector<std::array<uint32_t, 3>> base;
  std::vector<glm::vec3> base_weights;
  // Parallel to the vertices, or empty: vertices that coarser levels of detail leave out.
  std::vector<bool> covered;
};

// The visible skin: the faces of the group "body".
CastPiece SkinPiece(const CastLibrary& library, const BaseShape& shape);

// A part fitted to the shape.
CastPiece FitPart(const CastLibrary& library, const CastProxy& proxy, const BaseShape& shape);

// Positions of the vertices of a part on the shape `base`. `unshaped` is the base on which its
// offsets were measured; both in metres.
std::vector<glm::vec3> FitPositions(const CastProxy& proxy,
                                    std::span<const glm::vec3> base,
                                    std::span<const glm::vec3> unshaped);

// Unit normals, smooth across vertices with the same source, weighted by the angles of the
// triangles (Thuermer & Wuethrich, Journal of Graphics Tools 3(1), 1998).
std::vector<glm::vec3> SmoothNormals(std::span<const glm::vec3> positions,
                                     std::span<const uint32_t> source,
                                     std::span<const uint32_t> indices);

// Removes triangles whose three corners are all hidden, and unused vertices.
void RemoveHidden(CastPiece& piece, const std::vector<bool>& hidden);

}  // namespace lararium::import
