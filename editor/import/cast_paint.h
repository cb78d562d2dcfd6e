#pragma once

// Pictures of the cast: skins tinted, weathered and given stubble and the shade of
// hair; hair and brows dyed; all encoded small.

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/material.h"

namespace lararium::import {

// A picture with alpha in which everything takes one colour (sRGB-encoded, 0..1) and
// keeps its light and dark; none: as it is. PNG in, PNG out.
Result<human::Texture> DyedTexture(const std::string& name,
                                   std::span<const std::byte> encoded,
                                   const std::optional<glm::vec3>& colour,
                                   int max_size);

// The same picture without alpha as a JPEG.
Result<human::Texture> OpaqueTexture(const std::string& name,
                                     std::span<const std::byte> encoded,
                                     int max_size);

}  // namespace lararium::import
