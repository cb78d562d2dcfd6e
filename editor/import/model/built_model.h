#pragma once

// The figure that the child process built from a foreign file, with unchecked images.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "editor/import/model/bone_map.h"
#include "editor/import/model/model_textures.h"
#include "shared/human/human.h"

namespace lararium::import {

struct BuiltModel {
  human::Human human;                // Has no textures.
  std::vector<ModelImage> images;    // Input of PrepareTexture.
  std::vector<TextureUse> uses;      // Indices into `images`, parallel to `human.materials`.
  std::vector<glm::vec3> emissions;  // They become ImportedHuman::emissions.
  BoneNames bones;                   // This and the following fields are those of ImportedHuman.
  bool is_human = false;
  std::string bone_table;
  std::vector<NamedBone> joints;
  std::vector<std::string> bone_names;
  std::vector<std::string> notes;
};

Result<std::vector<std::byte>> PackModel(const BuiltModel& model);

// Validates everything, because a hostile file may have taken over the child process. Errors
// name the file.
Result<BuiltModel> UnpackModel(std::span<const std::byte> bytes, const std::string& where);

}  // namespace lararium::import
