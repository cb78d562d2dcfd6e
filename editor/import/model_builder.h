#pragma once

// From a scene of assimp to a human::Human. Internal to editor/import.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "editor/import/bone_map.h"
#include "editor/import/model_import.h"
#include "editor/import/model_scene.h"
#include "shared/human/human.h"

namespace lararium::import {

struct BuiltModel {
  struct Image {
    std::string name;
    std::vector<std::byte> encoded;  // as the file has it; unchecked
  };
  struct Use {
    int colour = -1;  // index into images, of each material
    int normal = -1;
  };

  human::Human human;         // without textures
  std::vector<Image> images;  // what PrepareTexture takes
  std::vector<Use> uses;      // parallel to human.materials
  BoneNames bones;
  bool is_human = false;
  std::string bone_table;
  std::vector<NamedBone> joints;
  std::vector<std::string> bone_names;
  std::vector<std::string> notes;
};

enum class Content { kFigure, kMotion };

Result<BuiltModel> BuildModel(const ModelScene& model,
                              const ImportOptions& options,
                              Content content);

// Between processes.
Result<std::vector<std::byte>> PackModel(const BuiltModel& model);
Result<BuiltModel> UnpackModel(std::span<const std::byte> bytes, const std::string& place);

}  // namespace lararium::import
