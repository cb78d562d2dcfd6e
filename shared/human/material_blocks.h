#pragma once

// Reads and writes textures and materials in FlatBuffers files. These are templates because each
// schema has its own tables with the same fields. Private to the readers and writers of such files.

#include <glm/vec3.hpp>
#include <memory>
#include <utility>
#include <vector>

#include "shared/core/flatbuffer_blocks.h"
#include "shared/human/material.h"

namespace lararium::human {

template <typename Vec3>
glm::vec3 ReadVec3(const Vec3* from) {
  return from == nullptr ? glm::vec3(0.0f) : glm::vec3(from->x(), from->y(), from->z());
}

template <typename From>
void ReadTexture(const From& from, BlockReader& reader, std::shared_ptr<const Texture>& to) {
  auto texture = std::make_shared<Texture>();
  reader.Read(from.name(), texture->name);
  reader.Read(from.encoded(), texture->encoded);
  to = std::move(texture);
}

template <typename From>
void ReadMaterial(const From& from, BlockReader& reader, Material& to) {
  reader.Read(from.name(), to.name);
  to.surface = static_cast<Surface>(from.surface());
  to.colour_texture = from.colour_texture();
  to.normal_texture = from.normal_texture();
  to.colour = ReadVec3(from.colour());
  to.roughness = from.roughness();
  to.alpha_cutoff = from.alpha_cutoff();
  to.two_sided = from.two_sided();
}

// create: CreateTexture of the schema.
template <typename Create>
auto WriteTextures(flatbuffers::FlatBufferBuilder& builder,
                   const std::vector<std::shared_ptr<const Texture>>& textures,
                   Create create) {
  return WriteTables(
      builder, textures, [create](auto& to, const std::shared_ptr<const Texture>& texture) {
        const auto name = to.CreateString(texture->name);
        const auto encoded = to.CreateVector(
            reinterpret_cast<const uint8_t*>(texture->encoded.data()), texture->encoded.size());
        return create(to, name, encoded);
      });
}

// create: CreateMaterial of the schema.
template <typename Vec3, typename Create>
auto WriteMaterials(flatbuffers::FlatBufferBuilder& builder,
                    const std::vector<Material>& materials,
                    Create create) {
  return WriteTables(builder, materials, [create](auto& to, const Material& material) {
    const auto name = to.CreateString(material.name);
    const Vec3 colour(material.colour.x, material.colour.y, material.colour.z);
    return create(to, name, static_cast<uint8_t>(material.surface), material.colour_texture,
                  material.normal_texture, &colour, material.roughness, material.alpha_cutoff,
                  material.two_sided);
  });
}

}  // namespace lararium::human
