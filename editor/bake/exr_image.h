#pragma once

// Linear images as OpenEXR files.

#include <filesystem>
#include <glm/vec4.hpp>
#include <span>

#include "shared/core/status.h"

namespace lararium::bake {

// RGBA, 32-bit floats, row by row from the top left; colour is premultiplied. Written
// beside the file and moved to its place when complete.
Status WriteExr(const std::filesystem::path& file,
                int width,
                int height,
                std::span<const glm::vec4> pixels);

}  // namespace lararium::bake
