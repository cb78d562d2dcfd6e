#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/material.h"

namespace lararium::human {

// A coarser version of a mesh: fewer triangles over the same vertices.
struct LevelOfDetail {
  float error = 0.0f;  // metres from the full detail
  std::vector<uint32_t> indices;
};

// Factor on the geometric error of a surface; viewers look most closely at faces.
float ErrorShare(Surface surface);

// Validates the triangles of a mesh and of its coarser levels. Errors call the mesh `where`.
Status ValidateTriangles(const std::vector<uint32_t>& indices,
                         const std::vector<LevelOfDetail>& coarser,
                         size_t vertex_count,
                         const std::string& where);

}  // namespace lararium::human
