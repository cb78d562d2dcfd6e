#pragma once

// Converts the materials and images of a glTF document to those of assimp. Internal to
// editor/import.

#include <assimp/scene.h>

#include <glm/mat3x3.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "editor/import/model/gltf_accessors.h"

namespace lararium::import {

// The texture coordinates that the colour texture of a material uses.
struct GltfUvs {
  size_t set = 0;                         // TEXCOORD_<set>
  glm::mat3 transform = glm::mat3(1.0f);  // KHR_texture_transform
  bool repeats = true;                    // False if the texture does not tile.

  friend bool operator==(const GltfUvs&, const GltfUvs&) = default;
};

// `material` is an index into the document's materials; nullopt is the default material.
GltfUvs ColourUvs(const GltfDocument& document, std::optional<size_t> material);

// Adds all materials, the default one as the last, and the images that are embedded. What the
// materials have and people here have not is added to `left_out`; images that cannot be used to
// `notes`.
void AddGltfMaterials(const GltfDocument& document,
                      const GltfAccessors& accessors,
                      aiScene& scene,
                      std::set<std::string>& left_out,
                      std::vector<std::string>& notes);

}  // namespace lararium::import
