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
// errors call it. jpeg_halvings: image::DecodeImage.
Result<cv::Mat> DecodeTexture(std::span<const std::byte> encoded,
                              const std::string& place,
                              int jpeg_halvings = 0);

// Multiplies sRGB-encoded colours by alpha in linear light: what is filtered then
// mixes no colour from where nothing is.
void PremultiplySrgb(cv::Mat& bgra);

enum class TextureUse {
  kColour,  // sRGB-encoded, premultiplied by alpha (PremultiplySrgb)
  kNormal   // linear, tangent space
};

// As it is to be on the GPU. halvings: how often it is half as wide and high, rounded up; fewer
// where its longer side would come below kLeastReducedSide.
inline constexpr int kLeastReducedSide = 128;
Result<cv::Mat> DecodeForUse(std::span<const std::byte> encoded,
                             TextureUse use,
                             int halvings,
                             const std::string& place);

}  // namespace lararium::render
