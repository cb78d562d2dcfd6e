#include <draco/compression/decode.h>

#include <exception>

#include "editor/import/model/gltf_accessors.h"

namespace lararium::import {
namespace {

constexpr uint32_t kMaxPoints = 10'000'000;

Status CannotBeDecoded(const std::string& where, const std::string& why) {
  return Status::Error(where, "its Draco compression cannot be decoded: " + why,
                       "export it without compression");
}

}  // namespace

Result<DracoMesh> DecodeDraco(std::span<const std::byte> bytes,
                              const std::map<std::string, uint32_t>& ids,
                              const std::string& where) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    return CannotBeDecoded(where, decoded.status().error_msg_string());
  }
  const draco::Mesh& mesh = *decoded.value();
  if (mesh.num_points() > kMaxPoints || mesh.num_faces() > kMaxPoints) {
    return CannotBeDecoded(where, "it has too many vertices");
  }
  DracoMesh result;
  result.vertices = mesh.num_points();
  for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f) {
    for (const draco::PointIndex& corner : mesh.face(f)) {
      result.indices.push_back(corner.value());
    }
  }
  for (const auto& [name, id] : ids) {
    const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id);
    if (attribute == nullptr) {
      return CannotBeDecoded(where, name + " is missing in it");
    }
    const auto components = static_cast<size_t>(attribute->num_components());
    std::vector<float>& values = result.attributes[name];
    values.resize(components * result.vertices);
    for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
      const draco::AttributeValueIndex index = attribute->mapped_index(point);
      if (index.value() >= attribute->size() ||
          !attribute->ConvertValue(index, attribute->num_components(),
                                   values.data() + components * point.value())) {
        return CannotBeDecoded(where, name + " is damaged");
      }
    }
  }
  return result;
}

}  // namespace lararium::import
