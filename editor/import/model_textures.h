#pragma once

// The images of a model: found, made safe, made small.

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
  std::vector<std::byte> encoded;  // as the file has it; unchecked
};

// The images of a material, as indices; -1: none.
struct TextureUse {
  int colour = -1;
  int normal = -1;
};

// Where a model's image lies: as the file says, else by its bare name beside the model,
// in textures/ or in MODEL.fbm/ (paths of the author's computer are common). Never
// outside the model's folder. Empty: not found.
std::filesystem::path FindTexture(const std::filesystem::path& model, std::string_view uri);

// Decoded, scaled down to kMaxTextureSide and encoded anew: JPEG, or PNG where some of it
// is transparent. Takes PNG, JPEG and BMP. Errors name the place; images of more than
// 67 million pixels are refused before they are decoded.
Result<human::Texture> PrepareTexture(const std::vector<std::byte>& encoded,
                                      const std::string& name,
                                      const std::string& place);

}  // namespace lararium::import
