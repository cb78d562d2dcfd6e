#pragma once

// Reads the materials that the parts of a scene use, and their images.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "editor/import/model/model_parts.h"
#include "editor/import/model/model_scene.h"
#include "editor/import/model/model_textures.h"
#include "shared/human/material.h"

namespace lararium::import {

struct ModelSurfaces {
  std::vector<human::Material> materials;  // Have no textures.
  std::vector<TextureUse> uses;            // Parallel to `materials`.
  std::vector<glm::vec3> vertex_colours;   // Linear colour of the vertices of each material.
  std::vector<glm::vec3> emissions;        // Emitted linear radiance of each material.
  std::vector<ModelImage> images;          // Each image occurs once.
  // Index into `materials` for each material of the scene, or Material::kNone.
  std::vector<int16_t> material_of;
};

// A material without a texture gives its colour to the vertices and becomes white. Images that
// cannot be used are listed in `notes` and left out.
ModelSurfaces ReadSurfaces(const ModelScene& model,
                           std::span<const Part> parts,
                           bool of_person,
                           std::vector<std::string>& notes);

}  // namespace lararium::import
