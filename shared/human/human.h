#pragma once

// A person as the player loads it from a .larhuman file.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/clip.h"
#include "shared/human/face_shape.h"
#include "shared/human/level_of_detail.h"
#include "shared/human/light_transfer.h"
#include "shared/human/material.h"
#include "shared/human/skeleton.h"
#include "shared/human/soft_parts.h"

namespace lararium::human {

// A skinned mesh with one material. Its vertex arrays are parallel.
struct SkinnedMesh {
  std::string name;
  std::vector<glm::vec3> positions;            // metres, actor frame, bind pose
  std::vector<glm::vec3> normals;              // unit
  std::vector<glm::vec3> albedo;               // linear RGB, 0..1
  std::vector<glm::vec2> uvs;                  // (0, 0) is the image's top left; may be empty
  std::vector<std::array<uint8_t, 4>> joints;  // joints of the four strongest influences
  std::vector<glm::vec4> weights;              // weights of these influences, sum 1
  std::vector<uint32_t> indices;               // three for each triangle
  // Distance of `indices` from the full detail, metres. Not 0 if ParseHuman left out finer levels,
  // or if the file lacks them, as in folders for browsers.
  float error = 0.0f;
  std::vector<LevelOfDetail> coarser;  // Each level is coarser than the one before.
  int16_t material = Material::kNone;  // Index into Human::materials; kNone: vertex albedo alone.

  // Returns kPlain if the mesh has no material.
  Surface SurfaceIn(std::span<const Material> materials) const;
  Status Validate(size_t joint_count, size_t material_count, const std::string& where) const;
};

enum class Skinning : uint8_t { kLinear, kDualQuaternion };

struct Human {
  std::string name;
  Skeleton skeleton;
  Skinning skinning = Skinning::kLinear;
  std::vector<std::shared_ptr<const Texture>> textures;  // Never nullptr; people may share them.
  std::vector<Material> materials;
  std::vector<SkinnedMesh> meshes;
  std::vector<MorphTarget> morphs;
  std::vector<FaceShape> face;
  std::vector<Cloth> cloths;  // A mesh has no more than one cloth.
  std::vector<SpringChain> springs;
  std::vector<BodyCapsule> capsules;
  std::vector<Clip> clips;
  LightTransfer light;  // empty if not baked
  std::string credits;  // authors and licences of the sources

  Status Validate(const std::string& where) const;
};

// finest: the largest acceptable error of a mesh in metres, after the factor ErrorShare. Levels of
// detail that are finer than needed, and the vertices that only they use, are not read. 0 reads
// everything.
Result<Human> ParseHuman(std::span<const std::byte> bytes,
                         const std::string& where,
                         float finest = 0.0f);
Result<Human> LoadHuman(const std::filesystem::path& file);
std::vector<std::byte> SerializeHuman(const Human& human);

}  // namespace lararium::human
