#pragma once

// Reads the EXIF data in the bytes of a JPEG, for ExifFocalPixels and ExifExposure
// (frame_source.h).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lararium::capture {

// Returns the focal length in millimetres of 35 mm film, above 0.
std::optional<uint32_t> FindFocalLengthIn35mmFilm(std::span<const std::byte> jpeg);

// Returns the exposure as in ExifExposure; finite and above 0.
std::optional<double> FindExposure(std::span<const std::byte> jpeg);

}  // namespace lararium::capture
