#pragma once

// A person as the player has it: the .larhuman file.

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

// A skinned part with one material. Arrays are parallel over its vertices.
struct SkinnedMesh {
  std::string name;
  std::vector<glm::vec3> positions;            // metres, actor frame, bind pose
  std::vector<glm::vec3> normals;              // unit
  std::vector<glm::vec3> albedo;               // linear RGB, 0..1
  std::vector<glm::vec2> uvs;                  // (0, 0) is the image's top left; may be empty
  std::vector<std::array<uint8_t, 4>> joints;  // of the four strongest influences
  std::vector<glm::vec4> weights;              // sum 1
  std::vector<uint32_t> indices;               // three for each triangle
  // Metres, of indices from the full detail: not 0 where finer levels were left out (ParseHuman).
  float error = 0.0f;
  std::vector<LevelOfDetail> coarser;  // each coarser than the one before
  int16_t material = Material::kNone;  // index into Human::materials; none: plain albedo

  // kPlain where it has no material.
  Surface SurfaceIn(std::span<const Material> materials) const;
  Status Validate(size_t joint_count, size_t material_count, const std::string& place) const;
};

enum class Skinning : uint8_t { kLinear, kDualQuaternion };

struct Human {
  std::string name;
  Skeleton skeleton;
  Skinning skinning = Skinning::kLinear;
  std::vector<std::shared_ptr<const Texture>> textures;  // none is nullptr; people share them
  std::vector<Material> materials;
  std::vector<SkinnedMesh> meshes;
  std::vector<MorphTarget> morphs;
  std::vector<FaceShape> face;
  std::vector<Cloth> cloths;  // at most one for each mesh
  std::vector<SpringChain> springs;
  std::vector<BodyCapsule> capsules;
  std::vector<Clip> clips;
  LightTransfer light;  // empty: not baked
  std::string credits;  // authors and licences of what it is made of

  Status Validate(const std::string& place) const;
};

// finest: levels of detail that are finer than it takes to be off by so much (metres, as errors
// count: ErrorShare) are not read, nor what only their vertices have. 0: all is read.
Result<Human> ParseHuman(std::span<const std::byte> bytes,
                         const std::string& place,
                         float finest = 0.0f);
Result<Human> LoadHuman(const std::filesystem::path& file);
// Of one that was read whole.
std::vector<std::byte> SerializeHuman(const Human& human);
Status SaveHuman(const std::filesystem::path& file, const Human& human);

}  // namespace lararium::human
