#pragma once

// What the EXIF data of a JPEG's bytes say; ExifFocalPixels and ExifExposure
// (frame_source.h) read files with it.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lararium::capture {

// The focal length in millimetres of 35 mm film, above 0.
std::optional<uint32_t> FindFocalLengthIn35mmFilm(std::span<const std::byte> jpeg);

// As ExifExposure; finite and above 0.
std::optional<double> FindExposure(std::span<const std::byte> jpeg);

}  // namespace lararium::capture
