#pragma once

// Reads and writes linear images as OpenEXR files.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec4.hpp>
#include <span>

#include "editor/bake/probe.h"
#include "shared/core/status.h"

namespace lararium::bake {

// Reads the colours of an image: the channels R, G and B, those of its main layer ("beauty",
// "Combined"), or luminance and chroma, in scan lines or tiles, of any part. The picture fills the
// display window; what its data window leaves out is black. Chromaticities are converted to those
// of BT.709. Warnings say which layer was taken and what is black. check: fails for sizes that are
// not wanted, before anything is read.
Result<ProbeImage> ReadExr(const std::filesystem::path& file,
                           const std::function<Status(int64_t width, int64_t height)>& check);

// Writes RGBA in 32-bit floats, row by row from the top left, colour premultiplied by alpha.
// The file is written under a temporary name and renamed when it is complete.
Status WriteExr(const std::filesystem::path& file,
                int width,
                int height,
                std::span<const glm::vec4> pixels);

}  // namespace lararium::bake
