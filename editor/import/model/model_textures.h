#pragma once

// Finds the images of a model, validates them and reduces their size.

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/material.h"

namespace lararium::import {

inline constexpr int kMaxTextureSide = 2048;  // pixels

struct ModelImage {
  std::string name;
  std::vector<std::byte> encoded;  // Bytes of the file, unchecked.
};

// Indices of the images of a material; -1 means none.
struct TextureUse {
  int colour = -1;
  int normal = -1;
};

// Finds an image or another part of a model: at the path in the file, with and without escapes
// such as %20, otherwise by its bare name beside the model, in textures/ or in MODEL.fbm/ (paths
// of the author's computer are common). Never outside the folder of the model. Empty if it is
// not found.
std::filesystem::path FindReferenced(const std::filesystem::path& model, std::string_view uri);

// Decodes an image, scales it down to kMaxTextureSide and encodes it as JPEG, or as PNG if a part
// is transparent. Errors name `where`. Refuses images of more than 67 million pixels before
// decoding.
Result<human::Texture> PrepareTexture(const std::vector<std::byte>& encoded,
                                      const std::string& name,
                                      const std::string& where);

}  // namespace lararium::import
