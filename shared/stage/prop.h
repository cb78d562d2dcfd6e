#pragma once

// A drawn object of a drama as the player has it: the .larprop file. How people
// use it is written in its `use` (object_use.h).

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/level_of_detail.h"
#include "shared/human/light_transfer.h"
#include "shared/human/material.h"

namespace lararium::stage {

// Where something is, rigidly: x_a = rotation * x_b + position.
struct Pose {
  glm::vec3 position = glm::vec3(0.0f);  // metres
  glm::quat rotation = glm::quat(1.0f, 0.0f, 0.0f, 0.0f);

  glm::vec3 operator*(const glm::vec3& point) const { return rotation * point + position; }
  Pose operator*(const Pose& other) const {
    return {rotation * other.position + position, glm::normalize(rotation * other.rotation)};
  }
  Pose Inverse() const {
    const glm::quat inverse = glm::conjugate(rotation);
    return {-(inverse * position), inverse};
  }
  friend bool operator==(const Pose&, const Pose&) = default;
};

// Triangles of one material. Arrays are parallel over the vertices.
struct PropMesh {
  std::vector<glm::vec3> positions;           // metres, part frame
  std::vector<glm::vec3> normals;             // unit
  std::vector<glm::vec3> albedo;              // linear RGB, 0..1
  std::vector<glm::vec2> uvs;                 // (0, 0) is the image's top left; may be empty
  std::vector<uint32_t> indices;              // three for each triangle, counter-clockwise outside
  std::vector<human::LevelOfDetail> coarser;  // ascending error; may be empty
  int16_t material = human::Material::kNone;  // index into Prop::materials; none: plain albedo
  // Light that it gives off by itself, linear RGB radiance: 1 is white in an image
  // of gain 1.
  glm::vec3 emission = glm::vec3(0.0f);

  Status Validate(size_t material_count, const std::string& place) const;
};

// A piece that can move against the others: a lid, a door leaf.
struct PropPart {
  static constexpr int16_t kNoParent = -1;

  std::string name;              // unique in the prop; as in `use`
  int16_t parent = kNoParent;    // an earlier part; none: the object itself
  Pose parent_from_part;         // at rest; joints turn about the part's own origin
  std::vector<PropMesh> meshes;  // may be empty: a frame of reference
};

// Object frame: metres, Y up, front towards -Z; the origin is where it rests on the
// ground or on a surface.
struct Prop {
  static constexpr size_t kMaxParts = 32;

  std::string name;
  std::vector<std::shared_ptr<const human::Texture>> textures;  // none is nullptr
  std::vector<human::Material> materials;
  std::vector<PropPart> parts;  // parents come before children
  // Text of NAME.object.json; empty: scenery that nobody uses. Checked by
  // ObjectModel::Create, not here.
  std::string use;
  std::string credits;  // authors and licences of what it is made of
  // How it answers to distant light; may be empty. Its joints are the parts, the bind pose is
  // each part's own frame, a key pose is object_from_part; of its meshes there is one for each
  // mesh of each part, in a row. It has no blockers: show finds them (show/prop_blockers.h).
  human::LightTransfer light;
  // Of each key pose of light, the parts that are there: bit i is part i.
  std::vector<uint32_t> light_shown;

  int FindPart(std::string_view part) const;  // -1: none
  Status Validate(const std::string& place) const;
};

// Everything is checked before use: structure, version, sizes, indices, numbers.
// place: what errors call the bytes. The same prop gives the same bytes.
Result<Prop> ParseProp(std::span<const std::byte> bytes, const std::string& place);
std::vector<std::byte> SerializeProp(const Prop& prop);

}  // namespace lararium::stage
