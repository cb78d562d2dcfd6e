#pragma once

// Checks the JSON of a glTF 2.0 file before its data is read, so that indices and extents in it
// can be used without further checks.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json.h"

namespace lararium::import {

struct GltfDocument {
  Json json;
  // The bytes of each buffer; of a GLB only the second chunk until ReadGltfBuffers is called.
  std::vector<std::vector<std::byte>> buffers;
  bool is_binary = false;

  // The name in the file, or the index if it has none.
  std::string NodeName(size_t node) const;
  // Names of the morph targets of a mesh; empty if the file has none.
  std::vector<std::string> TargetNames(size_t mesh) const;
};

// Says whether an extension is read, or harmless where it is not.
bool CanReadGltfExtension(std::string_view name);

// True for GLB, and for JSON with an asset; does not examine the rest of the file.
bool LooksLikeGltf(std::span<const std::byte> bytes);

// Errors: chunks that do not fit, unsupported versions and extensions, indices out of range,
// accessors outside their buffers, nodes that are their own ancestors, counts above our limits.
// Each names the location in the file.
Result<GltfDocument> ParseGltf(std::span<const std::byte> bytes, const std::string& where);

// Decodes the buffers that are part of the document and reads those in files beside `file`, never
// outside its folder.
Status ReadGltfBuffers(const std::filesystem::path& file, GltfDocument& document);

// Decodes base64 in a "data:" URI. Errors name `where`.
Result<std::vector<std::byte>> DecodeDataUri(std::string_view uri, const std::string& where);

// Says whether a path from a file stays below the folder of the file.
bool IsSafeRelativePath(std::string_view uri);

// ---- Fields that may be missing or of another type ----

const Json* Find(const Json& json, const char* key);
// An extension of an object of the document.
const Json* FindExtension(const Json& json, const char* name);
// EXT_meshopt_compression, or KHR_meshopt_compression, which is the same with a newer codec.
const Json* FindMeshopt(const Json& json);
std::string TextOr(const Json& json, const char* key, const std::string& instead);
// A whole number of at least 0.
size_t WholeOr(const Json& json, const char* key, size_t instead);
float NumberOr(const Json& json, const char* key, float instead);
// Reads a list of exactly as many numbers as `values` has; otherwise leaves them unchanged.
bool ReadNumbers(const Json& json, const char* key, std::span<float> values);

// Bytes of a component type, and components of an element type; 0 for unknown ones.
size_t GltfComponentBytes(int64_t type);
size_t GltfComponents(const std::string& type);

}  // namespace lararium::import
