#pragma once

// The .larmesh file: a triangle mesh (mesh.fbs).

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::stage {

// The same mesh gives the same bytes.
std::vector<std::byte> SerializeMesh(const geometry::TriangleMesh& mesh);

// Everything is checked before use: structure, version, sizes, indices, numbers.
// place: what errors call the bytes.
Result<geometry::TriangleMesh> ParseMesh(std::span<const std::byte> bytes,
                                         const std::string& place);

}  // namespace lararium::stage
