#pragma once

// Reads the EXIF data in the bytes of a JPEG, PNG, WebP, TIFF or HEIC file.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "shared/image/pixel_orientation.h"

namespace lararium::capture {

// Returns the focal length in millimetres of 35 mm film, above 0.
std::optional<uint32_t> FindFocalLengthIn35mmFilm(std::span<const std::byte> file);

// Returns the focal length in pixels of an image whose size is that of the whole sensor. Cameras
// mean the 35 mm film of equal diagonal.
double FocalPixels(uint32_t focal_in_35mm_film, int width, int height);

// Returns the maker and the model of the camera and its focal length, as one text: pictures whose
// texts differ were taken by different cameras or at different zooms. Empty if nothing is known.
std::string FindCameraName(std::span<const std::byte> file);

// Returns how the pixels that image::DecodeImage gives lie in the upright picture.
image::PixelOrientation FindOrientation(std::span<const std::byte> file);

// Returns the exposure as in ExifExposure; finite and above 0.
std::optional<double> FindExposure(std::span<const std::byte> file);

}  // namespace lararium::capture
