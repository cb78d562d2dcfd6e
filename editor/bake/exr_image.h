#pragma once

// Writes linear images as OpenEXR files.

#include <filesystem>
#include <glm/vec4.hpp>
#include <span>

#include "shared/core/status.h"

namespace lararium::bake {

// Writes RGBA in 32-bit floats, row by row from the top left, colour premultiplied by alpha.
// The file is written under a temporary name and renamed when it is complete.
Status WriteExr(const std::filesystem::path& file,
                int width,
                int height,
                std::span<const glm::vec4> pixels);

}  // namespace lararium::bake
