#pragma once

// Decodes the textures of people and props. Private to render.

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "shared/core/status.h"

namespace lararium::render {

// The widest and highest texture that is read; one of more is an error, before
// anything is decoded.
inline constexpr int kMaxTextureSide = 8192;

// Width and height that a PNG or JPEG says it has, from its header alone.
Result<cv::Size> ReadImageSize(std::span<const std::byte> encoded, const std::string& place);

// A PNG or JPEG as CV_8UC4, blue first, alpha 255 where it has none. place: what
// errors call it.
Result<cv::Mat> DecodeTexture(std::span<const std::byte> encoded, const std::string& place);

// Multiplies sRGB-encoded colours by alpha in linear light: what is filtered then
// mixes no colour from where nothing is.
void PremultiplySrgb(cv::Mat& bgra);

}  // namespace lararium::render
