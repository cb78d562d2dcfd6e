#pragma once

// Textures of surfaces on the GPU. Private to render.

#include <opencv2/core/mat.hpp>

#include "shared/render/gl_object.h"
#include "shared/render/texture_image.h"

namespace lararium::render {

// With all mipmaps, repeating. bgra: CV_8UC4.
// What is larger than the driver takes is halved until it fits.
GlTexture CreateSurfaceTexture(cv::Mat bgra, TextureUse use);

// One white pixel: stands in where a surface has no texture.
GlTexture CreateWhiteTexture();

}  // namespace lararium::render
