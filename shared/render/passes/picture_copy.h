#pragma once

// Copies pictures into textures of a headset's runtime. Needs OpenGL 3.3.

#include <cstdint>

#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/render_target.h"

namespace lararium::render {

class PictureCopy {
 public:
  // OpenGL formats of textures that can hold our pictures (sRGB-encoded, 8 bits) without
  // conversion. kEncodedFormat declares the encoding and is preferred; kPlainFormat is the
  // alternative.
  static constexpr int64_t kEncodedFormat = 0x8C43;  // GL_SRGB8_ALPHA8
  static constexpr int64_t kPlainFormat = 0x8058;    // GL_RGBA8

  // texture: two-dimensional, of the picture's size, in one of the formats above. Its bottom row is
  // stored first, as usual in OpenGL.
  void Into(uint32_t texture, const RenderTarget& picture) const;

 private:
  GlFramebuffer framebuffer_ = GlFramebuffer::Generate();
};

}  // namespace lararium::render
