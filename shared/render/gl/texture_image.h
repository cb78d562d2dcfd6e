#pragma once

// Decodes the textures of people and props. Private to render.

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "shared/core/status.h"

namespace lararium::render {

// Limit on the width and the height of textures. A larger texture is an error that is found before
// decoding.
inline constexpr int kMaxTextureSide = 8192;

// Width and height according to the header of a PNG or JPEG. where: name of the file in errors.
Result<cv::Size> ReadImageSize(std::span<const std::byte> encoded, const std::string& where);

// Decodes a PNG or JPEG to CV_8UC4 in the order BGRA; alpha is 255 if the file has none.
// where: name of the file in errors. jpeg_halvings: see image::DecodeImage.
Result<cv::Mat> DecodeTexture(std::span<const std::byte> encoded,
                              const std::string& where,
                              int jpeg_halvings = 0);

// Multiplies sRGB-encoded colours by alpha in linear light, so that filtering does not mix in
// colours of transparent pixels.
void PremultiplySrgb(cv::Mat& bgra);

enum class TextureUse {
  kColour,  // sRGB-encoded, premultiplied by alpha (PremultiplySrgb)
  kNormal   // linear, tangent space
};

// Decodes a texture to the form that it has on the GPU. halvings: how often its width and height
// are halved (rounded up); fewer if its longer side would become less than kLeastReducedSide.
inline constexpr int kLeastReducedSide = 128;
Result<cv::Mat> DecodeForUse(std::span<const std::byte> encoded,
                             TextureUse use,
                             int halvings,
                             const std::string& where);

}  // namespace lararium::render
