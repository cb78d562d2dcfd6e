#include "editor/import/model/gltf_accessors.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace lararium::import {
namespace {

template <typename T>
double Component(const std::byte* at, bool normalised) {
  T value;
  std::memcpy(&value, at, sizeof(value));
  if constexpr (std::is_integral_v<T>) {
    return normalised ? std::max(static_cast<double>(value) /
                                     static_cast<double>(std::numeric_limits<T>::max()),
                                 -1.0)
                      : static_cast<double>(value);
  } else {
    return value;
  }
}

// The component types that the check of the document accepts.
double ComponentOf(int64_t type, const std::byte* at, bool normalised) {
  switch (type) {
    case 5120:
      return Component<int8_t>(at, normalised);
    case 5121:
      return Component<uint8_t>(at, normalised);
    case 5122:
      return Component<int16_t>(at, normalised);
    case 5123:
      return Component<uint16_t>(at, normalised);
    case 5125:
      return Component<uint32_t>(at, normalised);
    default:
      return Component<float>(at, normalised);
  }
}

template <typename T>
T To(double value) {
  if constexpr (std::is_integral_v<T>) {
    return value >= 0.0 && value <= static_cast<double>(std::numeric_limits<T>::max())
               ? static_cast<T>(value)
               : std::numeric_limits<T>::max();
  } else {
    return static_cast<T>(value);
  }
}

// Reads `values.size()` components; the check of the document has compared the extent of the
// source with that of its view.
template <typename T>
void Copy(std::span<const std::byte> view,
          const Json& source,
          size_t stated_stride,
          int64_t type,
          bool normalised,
          size_t components,
          std::span<T> values) {
  const size_t bytes = GltfComponentBytes(type);
  const size_t stride = stated_stride == 0 ? components * bytes : stated_stride;
  const std::byte* first = view.data() + WholeOr(source, "byteOffset", 0);
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = To<T>(
        ComponentOf(type, first + i / components * stride + i % components * bytes, normalised));
  }
}

bool Filter(const std::string& filter, std::vector<std::byte>& bytes, size_t count, size_t stride) {
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
    meshopt_decodeFilterOct(bytes.data(), count, stride);
  } else if (filter == "QUATERNION" && stride == 8) {
    meshopt_decodeFilterQuat(bytes.data(), count, stride);
  } else if (filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(bytes.data(), count, stride);
  } else {
    return filter == "NONE";
  }
  return true;
}

}  // namespace

GltfAccessors::GltfAccessors(const GltfDocument& document, std::string where)
    : document_(document), where_(std::move(where)) {}

Status GltfAccessors::Problem(const std::string& where, const std::string& what) const {
  return Status::Error(where_, where + ": " + what, "export the file again");
}

size_t GltfAccessors::Count(size_t accessor) const {
  return WholeOr(document_.json["accessors"][accessor], "count", 0);
}

size_t GltfAccessors::Components(size_t accessor) const {
  return GltfComponents(TextOr(document_.json["accessors"][accessor], "type", ""));
}

Result<std::span<const std::byte>> GltfAccessors::View(size_t index) const {
  const Json& view = document_.json["bufferViews"][index];
  const std::string where = "bufferViews[" + std::to_string(index) + "]";
  const size_t length = WholeOr(view, "byteLength", 0);
  const size_t offset = WholeOr(view, "byteOffset", 0);
  const std::vector<std::byte>& buffer = document_.buffers[WholeOr(view, "buffer", 0)];
  const bool has_plain_data = offset + length <= buffer.size();
  if (const Json* compression = FindMeshopt(view)) {
    const auto known = decompressed_.find(index);
    if (known != decompressed_.end()) {
      return std::span<const std::byte>(known->second);
    }
    Result<std::vector<std::byte>> bytes = Decompress(*compression, where);
    if (bytes.ok()) {
      bytes->resize(std::max(bytes->size(), length));
      return std::span<const std::byte>(decompressed_[index] = *std::move(bytes));
    }
    if (!has_plain_data || length == 0) {
      return bytes.status();
    }
  }
  if (!has_plain_data) {
    return Problem(where, "reaches beyond the data of its buffer");
  }
  return std::span(buffer).subspan(offset, length);
}

// Unlike other parts of the document, the extension has not been checked before.
Result<std::vector<std::byte>> GltfAccessors::Decompress(const Json& compression,
                                                         const std::string& where) const {
  constexpr size_t kMost = size_t{1} << 30;
  const size_t buffer = WholeOr(compression, "buffer", kMost);
  const size_t offset = WholeOr(compression, "byteOffset", 0);
  const size_t length = WholeOr(compression, "byteLength", kMost);
  const size_t count = WholeOr(compression, "count", kMost);
  const size_t stride = WholeOr(compression, "byteStride", kMost);
  if (buffer >= document_.buffers.size() || stride == 0 || stride > 256 || count > kMost / stride ||
      length > document_.buffers[buffer].size() ||
      offset > document_.buffers[buffer].size() - length) {
    return Problem(where, "its compressed data is out of range");
  }
  const auto* data = reinterpret_cast<const unsigned char*>(document_.buffers[buffer].data());
  std::vector<std::byte> bytes(count * stride);
  const std::string mode = TextOr(compression, "mode", "");
  int error = -1;
  if (mode == "ATTRIBUTES" && stride % 4 == 0) {
    error = meshopt_decodeVertexBuffer(bytes.data(), count, stride, data + offset, length);
  } else if (mode == "TRIANGLES" && (stride == 2 || stride == 4) && count % 3 == 0) {
    error = meshopt_decodeIndexBuffer(bytes.data(), count, stride, data + offset, length);
  } else if (mode == "INDICES" && (stride == 2 || stride == 4)) {
    error = meshopt_decodeIndexSequence(bytes.data(), count, stride, data + offset, length);
  }
  const std::string filter = TextOr(compression, "filter", "NONE");
  if (error != 0 || !(mode == "ATTRIBUTES" ? Filter(filter, bytes, count, stride) : true)) {
    return Status::Error(where_,
                         where +
                             ": its compressed data cannot be decoded: it is damaged, or of a "
                             "newer kind than is known",
                         "export it without compression");
  }
  return bytes;
}

template <typename T>
Status GltfAccessors::ReplaceSparse(const Json& sparse,
                                    int64_t type,
                                    bool normalised,
                                    const std::string& where,
                                    std::span<T> values,
                                    size_t components) const {
  const Json& at = sparse["indices"];
  const Json& replaced = sparse["values"];
  LARARIUM_ASSIGN_OR_RETURN(const std::span<const std::byte> index_bytes,
                            View(at["bufferView"].get<size_t>()));
  LARARIUM_ASSIGN_OR_RETURN(const std::span<const std::byte> value_bytes,
                            View(replaced["bufferView"].get<size_t>()));
  std::vector<uint32_t> indices(WholeOr(sparse, "count", 0));
  std::vector<T> elements(indices.size() * components);
  Copy<uint32_t>(index_bytes, at, 0, at["componentType"].get<int64_t>(), false, 1, indices);
  Copy<T>(value_bytes, replaced, 0, type, normalised, components, elements);
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= values.size() / components) {
      return Problem(where, "an index is out of range");
    }
    std::copy_n(elements.begin() + static_cast<std::ptrdiff_t>(i * components), components,
                values.begin() + static_cast<std::ptrdiff_t>(indices[i] * components));
  }
  return Status();
}

template <typename T>
Result<std::vector<T>> GltfAccessors::Read(size_t index, size_t components) const {
  const Json& accessor = document_.json["accessors"][index];
  const std::string where = "accessors[" + std::to_string(index) + "]";
  if (Components(index) != components) {
    return Problem(where, "has elements of another type than its use needs");
  }
  const auto type = accessor["componentType"].get<int64_t>();
  const Json* normalised = Find(accessor, "normalized");
  const bool is_normalised = normalised != nullptr && normalised->is_boolean() && *normalised;
  std::vector<T> values(Count(index) * components);
  if (const Json* view = Find(accessor, "bufferView")) {
    const Json& stated = document_.json["bufferViews"][view->get<size_t>()];
    LARARIUM_ASSIGN_OR_RETURN(const std::span<const std::byte> bytes, View(view->get<size_t>()));
    Copy<T>(bytes, accessor, WholeOr(stated, "byteStride", 0), type, is_normalised, components,
            values);
  }
  if (const Json* sparse = Find(accessor, "sparse")) {
    LARARIUM_RETURN_IF_ERROR(
        ReplaceSparse<T>(*sparse, type, is_normalised, where, values, components));
  }
  return values;
}

Result<std::vector<float>> GltfAccessors::Floats(size_t accessor, size_t components) const {
  return Read<float>(accessor, components);
}

Result<std::vector<uint32_t>> GltfAccessors::Indices(size_t accessor) const {
  return Read<uint32_t>(accessor, 1);
}

}  // namespace lararium::import
