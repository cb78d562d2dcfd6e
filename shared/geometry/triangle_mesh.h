#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/core/status.h"

namespace lararium::geometry {

// An indexed triangle mesh. Counter-clockwise triangles face the viewer.
struct TriangleMesh {
  std::vector<glm::vec3> positions;  // metres
  std::vector<glm::vec3> normals;    // unit; empty, or one for each position
  std::vector<uint32_t> indices;     // three for each triangle

  // Reports inconsistent sizes, indices out of range and non-finite numbers.
  Status Validate(const std::string& where) const;
};

// Computes angle-weighted vertex normals; triangles without area contribute nothing.
void ComputeNormals(TriangleMesh& mesh);

}  // namespace lararium::geometry
