#pragma once

// glTF 2.0 before a library reads it: its JSON, checked. Assimp drops what VRM adds,
// follows some indices without a look, and takes bones for one another whose names are
// equal; what comes out of here names each node and mesh by its index.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"

namespace lararium::import {

struct GltfDocument {
  Json json;
  std::vector<std::byte> binary;  // the GLB's second chunk
  bool is_binary = false;

  // As the file has it; the index where it has none.
  std::string NodeName(size_t node) const;
  std::string MeshName(size_t mesh) const;
  // Of each morph target of a mesh; empty: it tells none.
  std::vector<std::string> TargetNames(size_t mesh) const;
};

// True of GLB and of JSON with an asset; the rest of the file is not looked at.
bool LooksLikeGltf(std::span<const std::byte> bytes);

// Errors: chunks that do not fit, wrong versions and extensions, indices out of range,
// accessors outside their buffers, nodes that are their own ancestors, more than our
// limits of anything. Each names the place within the file.
Result<GltfDocument> ParseGltf(std::span<const std::byte> bytes, const std::string& place);

// The document with node i named "n<i>" and mesh i "m<i>", in the form that it came in.
std::vector<std::byte> SerializeWithIndexNames(const GltfDocument& document);

// Whether a path from a file stays below the file's folder.
bool IsSafeRelativePath(std::string_view uri);

}  // namespace lararium::import
