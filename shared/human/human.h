#pragma once

// A person as the player has it: the .larhuman file.

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::human {

// A skinned part with one material. Arrays are parallel over its vertices.
struct SkinnedMesh {
  std::string name;
  std::vector<glm::vec3> positions;            // metres, actor frame, bind pose
  std::vector<glm::vec3> normals;              // unit
  std::vector<glm::vec3> albedo;               // linear RGB, 0..1
  std::vector<std::array<uint8_t, 4>> joints;  // of the four strongest influences
  std::vector<glm::vec4> weights;              // sum 1
  std::vector<uint32_t> indices;               // three for each triangle

  Status Validate(size_t joint_count, const std::string& place) const;
};

struct Human {
  std::string name;
  Skeleton skeleton;
  std::vector<SkinnedMesh> meshes;
  std::vector<Clip> clips;
  std::string credits;  // authors and licences of what it is made of

  Status Validate(const std::string& place) const;
};

Result<Human> ParseHuman(std::span<const std::byte> bytes, const std::string& place);
Result<Human> LoadHuman(const std::filesystem::path& file);
std::vector<std::byte> SerializeHuman(const Human& human);
Status SaveHuman(const std::filesystem::path& file, const Human& human);

// Linear blend skinning on the CPU: the oracle of the GPU's, and for baking.
void SkinMesh(const SkinnedMesh& mesh,
              std::span<const glm::mat4> skin,
              std::span<glm::vec3> positions,
              std::span<glm::vec3> normals);

}  // namespace lararium::human
