#pragma once

// Reads and writes .larmesh files, which hold one triangle mesh (mesh.fbs).

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/geometry/triangle_mesh.h"

namespace lararium::stage {

// Deterministic: the same mesh gives the same bytes.
std::vector<std::byte> SerializeMesh(const geometry::TriangleMesh& mesh);

// Checks structure, version, sizes, indices and numbers first. Error messages begin with `where`.
Result<geometry::TriangleMesh> ParseMesh(std::span<const std::byte> bytes,
                                         const std::string& where);

}  // namespace lararium::stage
