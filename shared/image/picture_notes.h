#pragma once

// What a picture file says of itself that reading it does not honour.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace lararium::image {

// Returns sentences without a subject: a colour profile (ICC.1:2022) of other primaries than those
// of sRGB, or a PNG's colour space of that kind or of high dynamic range, which DecodeImage() does
// not apply, and the pages of a TIFF after the first. Empty for ordinary pictures, and for files
// that cannot be read.
std::vector<std::string> PictureNotes(std::span<const std::byte> encoded);

}  // namespace lararium::image
