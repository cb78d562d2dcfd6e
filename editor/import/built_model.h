#pragma once

// A foreign figure as the process that read it hands it over: built, its images untouched.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "editor/import/bone_map.h"
#include "editor/import/model_textures.h"
#include "shared/human/human.h"

namespace lararium::import {

struct BuiltModel {
  human::Human human;              // without textures
  std::vector<ModelImage> images;  // what PrepareTexture takes
  std::vector<TextureUse> uses;    // of images, parallel to human.materials
  BoneNames bones;                 // from here on: as in ImportedHuman
  bool is_human = false;
  std::string bone_table;
  std::vector<NamedBone> joints;
  std::vector<std::string> bone_names;
  std::vector<std::string> notes;
};

Result<std::vector<std::byte>> PackModel(const BuiltModel& model);

// Believes nothing that it unpacks: a hostile file may have taken the other process over.
// Errors name the place.
Result<BuiltModel> UnpackModel(std::span<const std::byte> bytes, const std::string& place);

}  // namespace lararium::import
