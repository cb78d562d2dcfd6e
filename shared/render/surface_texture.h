#pragma once

// Textures of surfaces on the GPU. Private to render.

#include <opencv2/core/mat.hpp>

#include "shared/render/gl_object.h"

namespace lararium::render {

enum class TextureUse {
  kColour,  // sRGB-encoded, premultiplied by alpha (PremultiplySrgb)
  kNormal   // linear, tangent space
};

// With all mipmaps, repeating. bgra: CV_8UC4.
// What is larger than the driver takes is halved until it fits.
GlTexture CreateSurfaceTexture(cv::Mat bgra, TextureUse use);

// One white pixel: stands in where a surface has no texture.
GlTexture CreateWhiteTexture();

}  // namespace lararium::render
