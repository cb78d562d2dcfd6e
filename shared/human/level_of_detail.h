#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::human {

// Fewer triangles over the same vertices.
struct LevelOfDetail {
  float error = 0.0f;  // metres, from the full detail
  std::vector<uint32_t> indices;
};

// Of a mesh and its coarser levels. place: what errors call the mesh.
Status ValidateTriangles(const std::vector<uint32_t>& indices,
                         const std::vector<LevelOfDetail>& coarser,
                         size_t vertex_count,
                         const std::string& place);

}  // namespace lararium::human
