#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/material.h"

namespace lararium::human {

// Fewer triangles over the same vertices.
struct LevelOfDetail {
  float error = 0.0f;  // metres, from the full detail
  std::vector<uint32_t> indices;
};

// By how much the error of a surface counts: nobody looks at anything as closely as at faces.
float ErrorShare(Surface surface);

// Of a mesh and its coarser levels. place: what errors call the mesh.
Status ValidateTriangles(const std::vector<uint32_t>& indices,
                         const std::vector<LevelOfDetail>& coarser,
                         size_t vertex_count,
                         const std::string& place);

}  // namespace lararium::human
