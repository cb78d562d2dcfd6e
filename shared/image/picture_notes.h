#pragma once

// What a picture file says of itself that reading it does not honour.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lararium::image {

// Returns sentences without a subject: a colour profile (ICC.1:2022) of other primaries than those
// of sRGB, or such a colour space or one of high dynamic range by numbers (PNG, HEIC, AVIF), which
// DecodeImage() does not apply, and the pages of a TIFF after the first. Empty for ordinary
// pictures, and for files that cannot be read.
std::vector<std::string> PictureNotes(std::span<const std::byte> encoded);

}  // namespace lararium::image
