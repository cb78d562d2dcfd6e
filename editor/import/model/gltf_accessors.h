#pragma once

// Reads the numbers of a glTF document: strided, sparse, normalised and compressed ones. Internal
// to editor/import: only code in the child process of model_isolation reads foreign data with it.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "editor/import/model/model_gltf.h"

namespace lararium::import {

class GltfAccessors {
 public:
  // The document is checked (ParseGltf), has its buffers (ReadGltfBuffers), and must outlive
  // this.
  GltfAccessors(const GltfDocument& document, std::string where);

  size_t Count(size_t accessor) const;
  // Number of components of an element: 1 for SCALAR, 16 for MAT4.
  size_t Components(size_t accessor) const;

  // Returns the components of all elements, element by element. Normalised integers become numbers
  // in [-1, 1].
  Result<std::vector<float>> Floats(size_t accessor, size_t components) const;
  Result<std::vector<uint32_t>> Indices(size_t accessor) const;
  // The bytes of a buffer view; decompresses EXT_meshopt_compression. Where that fails, the
  // uncompressed data is taken if the file has it.
  Result<std::span<const std::byte>> View(size_t view) const;

  Status Problem(const std::string& where, const std::string& what) const;

 private:
  template <typename T>
  Result<std::vector<T>> Read(size_t accessor, size_t components) const;
  template <typename T>
  Status ReplaceSparse(const Json& sparse,
                       int64_t type,
                       bool normalised,
                       const std::string& where,
                       std::span<T> values,
                       size_t components) const;
  Result<std::vector<std::byte>> Decompress(const Json& compression,
                                            const std::string& where) const;

  const GltfDocument& document_;
  const std::string where_;
  mutable std::map<size_t, std::vector<std::byte>>
      decompressed_;  // The key is the index of the view.
};

// One primitive that is compressed with KHR_draco_mesh_compression.
struct DracoMesh {
  std::vector<uint32_t> indices;                         // Each triangle has three.
  std::map<std::string, std::vector<float>> attributes;  // The key is the name in glTF.
  size_t vertices = 0;
};

// `ids`: the attributes to decode, by name, and their unique ids in the compressed data. Errors
// name `where`.
Result<DracoMesh> DecodeDraco(std::span<const std::byte> bytes,
                              const std::map<std::string, uint32_t>& ids,
                              const std::string& where);

}  // namespace lararium::import
