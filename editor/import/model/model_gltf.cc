#include "editor/import/model/model_gltf.h"

#include <sodium.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

#include "editor/import/model/model_textures.h"
#include "shared/core/file.h"

namespace lararium::import {
namespace {

constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
constexpr uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
constexpr size_t kMaxJsonBytes = size_t{64} << 20;
constexpr size_t kMaxEntries = 20'000;  // Longest list of the document.
constexpr size_t kMaxDepth = 512;       // Levels of nested nodes.
constexpr int64_t kMaxElements = 10'000'000;
constexpr int64_t kMaxBytes = int64_t{1} << 30;

uint32_t ReadU32(std::span<const std::byte> bytes, size_t at) {
  uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));  // Both are little-endian.
  return value;
}

std::string_view Text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const Json& Entry(const Json& json, const char* list, size_t index) {
  static const Json kNothing;
  const Json* entries = Find(json, list);
  return entries != nullptr && entries->is_array() && index < entries->size() ? (*entries)[index]
                                                                              : kNothing;
}

// Checks one document and stops at the first error.
class Checker {
 public:
  Checker(const GltfDocument& document, const std::string& where)
      : document_(document), json_(document.json), place_(where) {}

  Status Check() {
    for (const auto& check :
         {&Checker::CheckHead, &Checker::CheckLists, &Checker::CheckBuffers,
          &Checker::CheckAccessors, &Checker::CheckMeshes, &Checker::CheckSkins,
          &Checker::CheckNodes, &Checker::CheckAnimations, &Checker::CheckImages}) {
      LARARIUM_RETURN_IF_ERROR((this->*check)());
    }
    return Status();
  }

 private:
  Status Problem(const std::string& where,
                 const std::string& what,
                 const std::string& remedy = "export the file again") const {
    return Status::Error(place_, where + ": " + what, remedy);
  }

  size_t Count(const char* list) const {
    const Json* entries = Find(json_, list);
    return entries != nullptr && entries->is_array() ? entries->size() : 0;
  }
  const Json& At(const char* list, size_t index) const { return Entry(json_, list, index); }

  static std::string Name(const char* list, size_t index) {
    return std::string(list) + "[" + std::to_string(index) + "]";
  }

  // Reads an integer in [0, max], or `instead` if the field is missing.
  Result<int64_t> Number(const Json& json,
                         const char* key,
                         int64_t max,
                         const std::string& where,
                         std::optional<int64_t> instead) const {
    const Json* value = Find(json, key);
    if (value == nullptr && instead.has_value()) {
      return *instead;
    }
    if (value == nullptr || !value->is_number_integer()) {
      return Problem(where, std::string(key) + " must be a whole number");
    }
    const bool negative = !value->is_number_unsigned() && value->get<int64_t>() < 0;
    if (negative || value->get<uint64_t>() > static_cast<uint64_t>(max)) {
      return Problem(where, std::string(key) + " is out of range");
    }
    return value->get<int64_t>();
  }

  // Checks an optional index into a list of the document.
  Status CheckIndex(const Json& json,
                    const char* key,
                    const char* list,
                    const std::string& where) const {
    if (Find(json, key) == nullptr) {
      return Status();
    }
    const auto count = static_cast<int64_t>(Count(list));
    if (count == 0) {
      return Problem(where,
                     std::string(key) + " refers to an entry of " + list + " that does not exist");
    }
    return Number(json, key, count - 1, where, std::nullopt).status();
  }

  // Checks indices into a list of the document.
  Status CheckIndices(const Json& indices,
                      const char* list,
                      size_t max,
                      const std::string& where) const {
    if (!indices.is_array() || indices.size() > max) {
      return Problem(where, "must be a list of at most " + std::to_string(max) + " indices");
    }
    for (const Json& index : indices) {
      if (!index.is_number_integer() || index.get<int64_t>() < 0 ||
          index.get<uint64_t>() >= Count(list)) {
        return Problem(where,
                       std::string("refers to an entry of ") + list + " that does not exist");
      }
    }
    return Status();
  }

  Status CheckHead() {
    const Json* asset = Find(json_, "asset");
    const std::string stated = asset == nullptr ? "" : TextOr(*asset, "version", "");
    if (!stated.starts_with("2.")) {
      return Status::Error(place_, "is glTF of version '" + stated.substr(0, 16) + "'",
                           "export it as glTF 2.0");
    }
    const Json* required = Find(json_, "extensionsRequired");
    if (required != nullptr && required->is_array()) {
      for (const Json& extension : *required) {
        if (!extension.is_string() || !CanReadGltfExtension(extension.get<std::string>())) {
          return Status::Error(place_,
                               "needs the glTF extension " + extension.dump().substr(0, 80) +
                                   ", which is not supported",
                               "export it without that");
        }
      }
    }
    return Status();
  }

  Status CheckLists() {
    for (const char* list :
         {"nodes", "meshes", "skins", "accessors", "bufferViews", "buffers", "materials",
          "textures", "images", "samplers", "animations", "scenes", "cameras"}) {
      const Json* entries = Find(json_, list);
      if (entries == nullptr) {
        continue;
      }
      if (!entries->is_array() || entries->size() > kMaxEntries) {
        return Problem(list, "must be a list of at most " + std::to_string(kMaxEntries));
      }
      for (size_t i = 0; i < entries->size(); ++i) {
        if (!(*entries)[i].is_object()) {
          return Problem(Name(list, i), "must be an object");
        }
      }
    }
    return Status();
  }

  // Buffers that no view or only compressed views use need no data of their own.
  std::vector<bool> StandIns() const {
    std::vector<bool> stands_in(Count("buffers"), true);
    for (size_t i = 0; i < Count("bufferViews"); ++i) {
      const size_t buffer = WholeOr(At("bufferViews", i), "buffer", SIZE_MAX);
      if (buffer < stands_in.size() && FindMeshopt(At("buffers", buffer)) == nullptr) {
        stands_in[buffer] = stands_in[buffer] && FindMeshopt(At("bufferViews", i)) != nullptr;
      }
    }
    return stands_in;
  }

  Status CheckBuffers() {
    const std::vector<bool> stands_in = StandIns();
    for (size_t i = 0; i < Count("buffers"); ++i) {
      const Json& buffer = At("buffers", i);
      const std::string where = Name("buffers", i);
      LARARIUM_ASSIGN_OR_RETURN(const int64_t length,
                                Number(buffer, "byteLength", kMaxBytes, where, std::nullopt));
      const std::string uri = TextOr(buffer, "uri", "");
      const size_t in_glb = document_.buffers.empty() ? 0 : document_.buffers[0].size();
      if (uri.empty() && !stands_in[i] && (i > 0 || in_glb < size_t(length))) {
        return Problem(where, "the file ends before its data does", "copy the whole file again");
      } else if (!uri.empty() && !uri.starts_with("data:") && !IsSafeRelativePath(uri)) {
        return Problem(where,
                       "names a file outside the model's folder: '" + uri.substr(0, 80) + "'",
                       "put all files of the model into one folder");
      }
    }
    for (size_t i = 0; i < Count("bufferViews"); ++i) {
      const Json& view = At("bufferViews", i);
      const std::string where = Name("bufferViews", i);
      LARARIUM_RETURN_IF_ERROR(CheckIndex(view, "buffer", "buffers", where));
      LARARIUM_ASSIGN_OR_RETURN(
          const int64_t buffer,
          Number(view, "buffer", static_cast<int64_t>(kMaxEntries), where, std::nullopt));
      LARARIUM_ASSIGN_OR_RETURN(
          const int64_t size,
          Number(At("buffers", static_cast<size_t>(buffer)), "byteLength", kMaxBytes, where, 0));
      LARARIUM_ASSIGN_OR_RETURN(const int64_t offset,
                                Number(view, "byteOffset", kMaxBytes, where, 0));
      LARARIUM_ASSIGN_OR_RETURN(const int64_t length,
                                Number(view, "byteLength", kMaxBytes, where, std::nullopt));
      LARARIUM_RETURN_IF_ERROR(Number(view, "byteStride", 252, where, 0).status());
      if (offset + length > size) {
        return Problem(where, "lies outside its buffer");
      }
    }
    return Status();
  }

  // Checks that `count` elements are inside a buffer view.
  Status CheckExtent(const Json& source,
                     int64_t element_bytes,
                     int64_t count,
                     const std::string& where) const {
    LARARIUM_RETURN_IF_ERROR(CheckIndex(source, "bufferView", "bufferViews", where));
    if (Find(source, "bufferView") == nullptr) {
      return Status();  // An accessor without a view contains zeros.
    }
    LARARIUM_ASSIGN_OR_RETURN(
        const int64_t index,
        Number(source, "bufferView", static_cast<int64_t>(kMaxEntries), where, std::nullopt));
    const Json& view = At("bufferViews", static_cast<size_t>(index));
    LARARIUM_ASSIGN_OR_RETURN(const int64_t length,
                              Number(view, "byteLength", kMaxBytes, where, std::nullopt));
    LARARIUM_ASSIGN_OR_RETURN(const int64_t stated, Number(view, "byteStride", 252, where, 0));
    LARARIUM_ASSIGN_OR_RETURN(const int64_t offset,
                              Number(source, "byteOffset", kMaxBytes, where, 0));
    const int64_t stride = stated == 0 ? element_bytes : stated;
    if (count > 0 &&
        (stride < element_bytes || offset + stride * (count - 1) + element_bytes > length)) {
      return Problem(where, "reaches beyond its buffer view");
    }
    return Status();
  }

  Status CheckAccessors() {
    for (size_t i = 0; i < Count("accessors"); ++i) {
      const Json& accessor = At("accessors", i);
      const std::string where = Name("accessors", i);
      LARARIUM_ASSIGN_OR_RETURN(const int64_t count,
                                Number(accessor, "count", kMaxElements, where, std::nullopt));
      LARARIUM_ASSIGN_OR_RETURN(const int64_t type,
                                Number(accessor, "componentType", 6000, where, std::nullopt));
      const auto bytes = static_cast<int64_t>(GltfComponentBytes(type) *
                                              GltfComponents(TextOr(accessor, "type", "")));
      if (bytes == 0) {
        return Problem(where, "its type is not one of glTF");
      }
      LARARIUM_RETURN_IF_ERROR(CheckExtent(accessor, bytes, count, where));
      if (const Json* sparse = Find(accessor, "sparse")) {
        LARARIUM_RETURN_IF_ERROR(CheckSparse(*sparse, bytes, count, where + ".sparse"));
      }
    }
    return Status();
  }

  Status CheckSparse(const Json& sparse,
                     int64_t element_bytes,
                     int64_t element_count,
                     const std::string& where) const {
    LARARIUM_ASSIGN_OR_RETURN(const int64_t count,
                              Number(sparse, "count", element_count, where, std::nullopt));
    const Json* indices = Find(sparse, "indices");
    const Json* values = Find(sparse, "values");
    if (indices == nullptr || values == nullptr || Find(*indices, "bufferView") == nullptr ||
        Find(*values, "bufferView") == nullptr) {
      return Problem(where, "needs indices and values");
    }
    LARARIUM_ASSIGN_OR_RETURN(const int64_t type,
                              Number(*indices, "componentType", 6000, where, std::nullopt));
    if (type != 5121 && type != 5123 && type != 5125) {
      return Problem(where, "its indices must be whole numbers");
    }
    LARARIUM_RETURN_IF_ERROR(
        CheckExtent(*indices, static_cast<int64_t>(GltfComponentBytes(type)), count, where));
    return CheckExtent(*values, element_bytes, count, where);
  }

  // Checks that each accessor of a primitive has one element per vertex.
  Status CheckAttributes(const Json* attributes,
                         int64_t& vertices,
                         const std::string& where) const {
    if (attributes == nullptr || !attributes->is_object()) {
      return Problem(where, "attributes are missing");
    }
    for (const auto& [name, index] : attributes->items()) {
      LARARIUM_RETURN_IF_ERROR(CheckIndex(*attributes, name.c_str(), "accessors", where));
      const int64_t count = At("accessors", index.get<size_t>()).at("count").get<int64_t>();
      if (vertices >= 0 && count != vertices) {
        return Problem(where, "its attributes differ in length");
      }
      vertices = count;
    }
    return Status();
  }

  Status CheckMeshes() {
    size_t primitives = 0;
    for (size_t m = 0; m < Count("meshes"); ++m) {
      const std::string where = Name("meshes", m);
      const Json* list = Find(At("meshes", m), "primitives");
      if (list == nullptr || !list->is_array() || (primitives += list->size()) > kMaxEntries) {
        return Problem(where, "must have primitives, and not too many");
      }
      for (const Json& primitive : *list) {
        int64_t vertices = -1;
        LARARIUM_RETURN_IF_ERROR(CheckAttributes(Find(primitive, "attributes"), vertices, where));
        LARARIUM_RETURN_IF_ERROR(CheckIndex(primitive, "indices", "accessors", where));
        LARARIUM_RETURN_IF_ERROR(CheckIndex(primitive, "material", "materials", where));
        const Json* targets = Find(primitive, "targets");
        if (targets == nullptr) {
          continue;
        }
        if (!targets->is_array() || targets->size() > 1024) {
          return Problem(where, "has more than 1024 morph targets");
        }
        for (const Json& target : *targets) {
          LARARIUM_RETURN_IF_ERROR(CheckAttributes(&target, vertices, where + ".targets"));
        }
      }
    }
    return Status();
  }

  Status CheckSkins() {
    for (size_t s = 0; s < Count("skins"); ++s) {
      const std::string where = Name("skins", s);
      const Json* joints = Find(At("skins", s), "joints");
      if (joints == nullptr) {
        return Problem(where, "has no joints");
      }
      LARARIUM_RETURN_IF_ERROR(CheckIndices(*joints, "nodes", 4096, where + ".joints"));
      LARARIUM_RETURN_IF_ERROR(
          CheckIndex(At("skins", s), "inverseBindMatrices", "accessors", where));
      const Json* matrices = Find(At("skins", s), "inverseBindMatrices");
      if (matrices != nullptr) {
        const Json& accessor = At("accessors", matrices->get<size_t>());
        if (accessor.at("count").get<size_t>() < joints->size() ||
            TextOr(accessor, "type", "") != "MAT4") {
          return Problem(where, "has fewer bind matrices than joints");
        }
      }
    }
    return Status();
  }

  // Checks that every node has at most one parent and has a root within the depth limit.
  Status CheckNodes() {
    const size_t count = Count("nodes");
    std::vector<size_t> depth(count, 0);
    std::vector<bool> has_parent(count, false);
    for (size_t n = 0; n < count; ++n) {
      const std::string where = Name("nodes", n);
      LARARIUM_RETURN_IF_ERROR(CheckIndex(At("nodes", n), "mesh", "meshes", where));
      LARARIUM_RETURN_IF_ERROR(CheckIndex(At("nodes", n), "skin", "skins", where));
      LARARIUM_RETURN_IF_ERROR(CheckIndex(At("nodes", n), "camera", "cameras", where));
      const Json* children = Find(At("nodes", n), "children");
      if (children == nullptr) {
        continue;
      }
      LARARIUM_RETURN_IF_ERROR(CheckIndices(*children, "nodes", count, where + ".children"));
      for (const Json& child : *children) {
        if (has_parent[child.get<size_t>()]) {
          return Problem(where, "shares a child with another node");
        }
        has_parent[child.get<size_t>()] = true;
      }
    }
    std::vector<size_t> open;
    for (size_t n = 0; n < count; ++n) {
      if (!has_parent[n]) {
        open.push_back(n);
      }
    }
    for (size_t i = 0; i < open.size(); ++i) {
      const Json* children = Find(At("nodes", open[i]), "children");
      for (size_t c = 0; children != nullptr && c < children->size(); ++c) {
        const auto child = (*children)[c].get<size_t>();
        depth[child] = depth[open[i]] + 1;
        if (depth[child] > kMaxDepth) {
          return Problem(Name("nodes", child), "lies more than 512 levels deep");
        }
        open.push_back(child);
      }
    }
    if (open.size() != count) {
      return Problem("nodes", "some are their own ancestors");
    }
    for (size_t s = 0; s < Count("scenes"); ++s) {
      if (const Json* roots = Find(At("scenes", s), "nodes")) {
        LARARIUM_RETURN_IF_ERROR(CheckIndices(*roots, "nodes", count, Name("scenes", s)));
      }
    }
    return CheckIndex(json_, "scene", "scenes", "scene");
  }

  Status CheckAnimations() {
    for (size_t a = 0; a < Count("animations"); ++a) {
      const std::string where = Name("animations", a);
      const Json* channels = Find(At("animations", a), "channels");
      const Json* samplers = Find(At("animations", a), "samplers");
      if (channels == nullptr || samplers == nullptr || !channels->is_array() ||
          !samplers->is_array() || channels->size() > 4 * kMaxEntries) {
        return Problem(where, "has no channels and samplers, or too many");
      }
      for (const Json& sampler : *samplers) {
        LARARIUM_RETURN_IF_ERROR(CheckIndex(sampler, "input", "accessors", where));
        LARARIUM_RETURN_IF_ERROR(CheckIndex(sampler, "output", "accessors", where));
      }
      for (const Json& channel : *channels) {
        const auto count = static_cast<int64_t>(samplers->size());
        LARARIUM_RETURN_IF_ERROR(
            Number(channel, "sampler", count - 1, where, std::nullopt).status());
        const Json* target = Find(channel, "target");
        if (target == nullptr) {
          return Problem(where, "a channel has no target");
        }
        LARARIUM_RETURN_IF_ERROR(CheckIndex(*target, "node", "nodes", where));
      }
    }
    return Status();
  }

  Status CheckImages() {
    for (size_t i = 0; i < Count("images"); ++i) {
      LARARIUM_RETURN_IF_ERROR(
          CheckIndex(At("images", i), "bufferView", "bufferViews", Name("images", i)));
    }
    for (size_t t = 0; t < Count("textures"); ++t) {
      LARARIUM_RETURN_IF_ERROR(
          CheckIndex(At("textures", t), "source", "images", Name("textures", t)));
      LARARIUM_RETURN_IF_ERROR(
          CheckIndex(At("textures", t), "sampler", "samplers", Name("textures", t)));
    }
    return Status();
  }

  const GltfDocument& document_;
  const Json& json_;
  const std::string& place_;
};

Result<GltfDocument> SplitBinary(std::span<const std::byte> bytes, const std::string& where) {
  const auto cut = [&] {
    return Status::Error(where, "the file is cut off or damaged", "copy or export it again");
  };
  if (bytes.size() < kHeaderBytes + kChunkHeaderBytes || ReadU32(bytes, 8) > bytes.size()) {
    return cut();
  }
  if (ReadU32(bytes, 4) != 2) {
    return Status::Error(where, "is GLB of version " + std::to_string(ReadU32(bytes, 4)),
                         "export it as glTF 2.0");
  }
  GltfDocument document;
  document.is_binary = true;
  size_t at = kHeaderBytes;
  bool has_json = false;
  while (at + kChunkHeaderBytes <= bytes.size()) {
    const size_t length = ReadU32(bytes, at);
    const uint32_t type = ReadU32(bytes, at + 4);
    at += kChunkHeaderBytes;
    if (length > bytes.size() - at) {
      return cut();
    }
    const auto chunk = bytes.subspan(at, length);
    if (type == kJsonChunk && !has_json) {
      if (length > kMaxJsonBytes) {
        return Status::Error(where, "its description is larger than 64 MiB");
      }
      LARARIUM_ASSIGN_OR_RETURN(document.json, ParseJson(Text(chunk), where));
      has_json = true;
    } else if (type == kBinaryChunk && document.buffers.empty()) {
      document.buffers.emplace_back(chunk.begin(), chunk.end());
    }
    at += length + (4 - length % 4) % 4;
  }
  return has_json ? Result<GltfDocument>(std::move(document)) : Result<GltfDocument>(cut());
}

}  // namespace

std::string GltfDocument::NodeName(size_t node) const {
  return TextOr(Entry(json, "nodes", node), "name", "node " + std::to_string(node));
}

std::vector<std::string> GltfDocument::TargetNames(size_t mesh) const {
  const Json& entry = Entry(json, "meshes", mesh);
  std::vector<const Json*> holders = {&entry};
  if (const Json* primitives = Find(entry, "primitives")) {
    for (const Json& primitive : *primitives) {
      holders.push_back(&primitive);
    }
  }
  for (const Json* holder : holders) {
    const Json* extras = Find(*holder, "extras");
    const Json* list = extras == nullptr ? nullptr : Find(*extras, "targetNames");
    if (list != nullptr && list->is_array()) {
      std::vector<std::string> names;
      for (const Json& name : *list) {
        names.push_back(name.is_string() ? name.get<std::string>() : std::string());
      }
      return names;
    }
  }
  return {};
}

bool CanReadGltfExtension(std::string_view name) {
  for (const char* known :
       {"KHR_materials_", "KHR_texture_transform", "KHR_lights_punctual", "KHR_xmp", "VRM",
        "EXT_texture_webp", "EXT_texture_avif", "KHR_draco_mesh_compression",
        "EXT_meshopt_compression", "KHR_meshopt_compression", "KHR_mesh_quantization",
        "EXT_mesh_gpu_instancing", "KHR_node_visibility"}) {
    if (name.starts_with(known)) {
      return true;
    }
  }
  return false;
}

const Json* FindMeshopt(const Json& json) {
  const Json* compression = FindExtension(json, "EXT_meshopt_compression");
  return compression != nullptr ? compression : FindExtension(json, "KHR_meshopt_compression");
}

bool LooksLikeGltf(std::span<const std::byte> bytes) {
  const std::string_view head = Text(bytes.first(std::min<size_t>(bytes.size(), 4096)));
  if (head.starts_with("glTF")) {
    return true;
  }
  const size_t first = head.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return first != std::string_view::npos && head[first] == '{';
}

Result<GltfDocument> ParseGltf(std::span<const std::byte> bytes, const std::string& where) {
  GltfDocument document;
  if (Text(bytes).starts_with("glTF")) {
    LARARIUM_ASSIGN_OR_RETURN(document, SplitBinary(bytes, where));
  } else {
    LARARIUM_ASSIGN_OR_RETURN(document.json, ParseJson(Text(bytes), where));
  }
  LARARIUM_RETURN_IF_ERROR(Checker(document, where).Check());
  return document;
}

Status ReadGltfBuffers(const std::filesystem::path& file, GltfDocument& document) {
  const Json* buffers = Find(document.json, "buffers");
  document.buffers.resize(buffers == nullptr ? 0 : buffers->size());
  for (size_t i = 0; i < document.buffers.size(); ++i) {
    const std::string uri = TextOr((*buffers)[i], "uri", "");
    const std::string where = file.string() + ": buffers[" + std::to_string(i) + "]";
    if (uri.starts_with("data:")) {
      LARARIUM_ASSIGN_OR_RETURN(document.buffers[i], DecodeDataUri(uri, where));
    } else if (!uri.empty()) {
      const std::filesystem::path found = FindReferenced(file, uri);
      if (found.empty()) {
        return Status::Error(where, "its file '" + uri.substr(0, 256) + "' is missing",
                             "put all files of the model into one folder");
      }
      LARARIUM_ASSIGN_OR_RETURN(document.buffers[i], ReadBytes(found));
    }
    if (!uri.empty() && document.buffers[i].size() < WholeOr((*buffers)[i], "byteLength", 0)) {
      return Status::Error(where, "holds fewer bytes than it says", "copy all files again");
    }
  }
  return Status();
}

Result<std::vector<std::byte>> DecodeDataUri(std::string_view uri, const std::string& where) {
  const size_t comma = uri.find(',');
  const std::string_view text = uri.substr(comma == uri.npos ? uri.size() : comma + 1);
  std::vector<std::byte> bytes(text.size() / 4 * 3 + 3);
  size_t size = 0;
  if (comma == uri.npos || uri.substr(0, comma).find("base64") == uri.npos ||
      sodium_base642bin(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), text.data(),
                        text.size(), " \r\n\t=", &size, nullptr,
                        sodium_base64_VARIANT_ORIGINAL_NO_PADDING) != 0) {
    return Status::Error(where, "its data is not valid base64", "export the file again");
  }
  bytes.resize(size);
  return bytes;
}

bool IsSafeRelativePath(std::string_view uri) {
  if (uri.empty() || uri.size() > 1024 || uri.find('\0') != std::string_view::npos ||
      uri.find(':') != std::string_view::npos || uri[0] == '/' || uri[0] == '\\') {
    return false;
  }
  std::string path(uri);
  std::replace(path.begin(), path.end(), '\\', '/');
  const std::filesystem::path normal = std::filesystem::path(path).lexically_normal();
  return *normal.begin() != ".." && path.find("%2e") == std::string::npos &&
         path.find("%2E") == std::string::npos;
}

const Json* Find(const Json& json, const char* key) {
  if (!json.is_object()) {
    return nullptr;
  }
  const auto found = json.find(key);
  return found == json.end() ? nullptr : &*found;
}

const Json* FindExtension(const Json& json, const char* name) {
  const Json* extensions = Find(json, "extensions");
  return extensions == nullptr ? nullptr : Find(*extensions, name);
}

std::string TextOr(const Json& json, const char* key, const std::string& instead) {
  const Json* text = Find(json, key);
  return text != nullptr && text->is_string() ? text->get<std::string>() : instead;
}

size_t WholeOr(const Json& json, const char* key, size_t instead) {
  const Json* value = Find(json, key);
  const bool is_whole = value != nullptr && value->is_number_integer() &&
                        (value->is_number_unsigned() || value->get<int64_t>() >= 0);
  return is_whole ? value->get<size_t>() : instead;
}

float NumberOr(const Json& json, const char* key, float instead) {
  const Json* value = Find(json, key);
  return value != nullptr && value->is_number() ? value->get<float>() : instead;
}

bool ReadNumbers(const Json& json, const char* key, std::span<float> values) {
  const Json* list = Find(json, key);
  if (list == nullptr || !list->is_array() || list->size() != values.size() ||
      !std::all_of(list->begin(), list->end(), [](const Json& n) { return n.is_number(); })) {
    return false;
  }
  std::transform(list->begin(), list->end(), values.begin(),
                 [](const Json& number) { return number.get<float>(); });
  return true;
}

size_t GltfComponentBytes(int64_t type) {
  static const std::map<int64_t, size_t> kTypes = {{5120, 1}, {5121, 1}, {5122, 2},
                                                   {5123, 2}, {5125, 4}, {5126, 4}};
  const auto found = kTypes.find(type);
  return found == kTypes.end() ? 0 : found->second;
}

size_t GltfComponents(const std::string& type) {
  static const std::map<std::string, size_t> kTypes = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  const auto found = kTypes.find(type);
  return found == kTypes.end() ? 0 : found->second;
}

}  // namespace lararium::import
