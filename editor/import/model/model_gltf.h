#pragma once

// Validates the JSON of a glTF 2.0 file before a library reads it. Assimp drops the VRM
// extensions, follows some indices without checking them, and confuses bones with equal names;
// after SerializeWithIndexNames each node and mesh has its index as its name.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"

namespace lararium::import {

struct GltfDocument {
  Json json;
  std::vector<std::byte> binary;  // The second chunk of a GLB.
  bool is_binary = false;

  // The name in the file, or the index if it has none.
  std::string NodeName(size_t node) const;
  // Names of the morph targets of a mesh; empty if the file has none.
  std::vector<std::string> TargetNames(size_t mesh) const;
};

// True for GLB, and for JSON with an asset; does not examine the rest of the file.
bool LooksLikeGltf(std::span<const std::byte> bytes);

// Errors: chunks that do not fit, unsupported versions and extensions, indices out of range,
// accessors outside their buffers, nodes that are their own ancestors, counts above our limits.
// Each names the location in the file.
Result<GltfDocument> ParseGltf(std::span<const std::byte> bytes, const std::string& where);

// The document with node i named "n<i>" and mesh i "m<i>", in its original format.
std::vector<std::byte> SerializeWithIndexNames(const GltfDocument& document);

// Says whether a path from a file stays below the folder of the file.
bool IsSafeRelativePath(std::string_view uri);

}  // namespace lararium::import
