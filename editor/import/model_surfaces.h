#pragma once

// The materials of a scene that its parts use, and the images that these need.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "editor/import/model_parts.h"
#include "editor/import/model_scene.h"
#include "editor/import/model_textures.h"
#include "shared/human/material.h"

namespace lararium::import {

struct ModelSurfaces {
  std::vector<human::Material> materials;  // without textures
  std::vector<TextureUse> uses;            // parallel to materials
  std::vector<glm::vec3> vertex_colours;   // of each material, linear: its vertices bear it
  std::vector<ModelImage> images;          // each once
  std::vector<int16_t> material_of;        // of each material of the scene, or Material::kNone
};

// A material without a texture gives its colour to the vertices and is white itself.
// Images that cannot be used are added to the notes and left out.
ModelSurfaces ReadSurfaces(const ModelScene& model,
                           std::span<const Part> parts,
                           std::vector<std::string>& notes);

}  // namespace lararium::import
