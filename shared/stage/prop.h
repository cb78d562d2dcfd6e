#pragma once

// A drawn object of a drama: the contents of a .larprop file. Its text `use` describes how actors
// use it (object_use.h).

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

// A rigid transform a_from_b: x_a = rotation * x_b + position.
struct Pose {
  glm::vec3 position = glm::vec3(0.0f);  // Metres.
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
  std::vector<glm::vec3> positions;           // Part frame, metres.
  std::vector<glm::vec3> normals;             // Unit vectors.
  std::vector<glm::vec3> albedo;              // Linear RGB, 0..1.
  std::vector<glm::vec2> uvs;                 // (0, 0) is the image's top left; may be empty..
  std::vector<uint32_t> indices;              // Three per triangle, counter-clockwise outside.
  std::vector<human::LevelOfDetail> coarser;  // Ascending error; may be empty.
  int16_t material = human::Material::kNone;  // Index into Prop::materials; kNone: albedo only.
  // Emitted linear RGB radiance: 1 is white in an image of gain 1.
  glm::vec3 emission = glm::vec3(0.0f);

  Status Validate(size_t material_count, const std::string& where) const;
};

// A part that can move relative to the others, such as a lid or a door leaf.
struct PropPart {
  static constexpr int16_t kNoParent = -1;

  std::string name;              // Unique in the prop; `use` refers to it.
  int16_t parent = kNoParent;    // Index of an earlier part; kNoParent: the object itself.
  Pose parent_from_part;         // Rest pose. Joints turn about the part's own origin.
  std::vector<PropMesh> meshes;  // May be empty: the part is only a frame of reference.
};

// Object frame: metres, Y up, front towards -Z, origin where the object rests on the ground or on a
// surface.
struct Prop {
  static constexpr size_t kMaxParts = 32;

  std::string name;
  std::vector<std::shared_ptr<const human::Texture>> textures;  // None is nullptr.
  std::vector<human::Material> materials;
  std::vector<PropPart> parts;  // Parents come before children.
  // Text of NAME.object.json; empty: scenery that cannot be used. ObjectModel::Create checks it,
  // Validate does not.
  std::string use;
  std::string credits;  // Authors and licences of the materials used.
  // Response to distant light; may be empty. Its joints are the parts: the bind pose of a joint is
  // the part's own frame and a key pose is object_from_part. It has one mesh per mesh of each part,
  // in order. It has no blockers; show computes them (show/prop_blockers.h).
  human::LightTransfer light;
  // The parts that are shown in each key pose of `light`: bit i is part i.
  std::vector<uint32_t> light_shown;

  int FindPart(std::string_view part) const;  // Index into `parts`; -1: none.
  Status Validate(const std::string& where) const;
};

// ParseProp checks structure, version, sizes, indices and numbers; error messages begin with
// `where`. SerializeProp is deterministic: the same prop gives the same bytes.
Result<Prop> ParseProp(std::span<const std::byte> bytes, const std::string& where);
std::vector<std::byte> SerializeProp(const Prop& prop);

}  // namespace lararium::stage
