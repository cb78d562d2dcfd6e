#pragma once

// Creates the textures of surfaces on the GPU. Private to render.

#include <opencv2/core/mat.hpp>

#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/texture_image.h"

namespace lararium::render {

// Creates a repeating texture with all mipmaps. bgra: CV_8UC4.
// Images larger than the driver's limit are halved until they fit.
GlTexture CreateSurfaceTexture(cv::Mat bgra, TextureUse use);

// One white pixel, for surfaces without a texture.
GlTexture CreateWhiteTexture();

}  // namespace lararium::render
