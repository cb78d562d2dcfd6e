#pragma once

// Copies pictures into the textures of others: a headset's runtime. With OpenGL 3.3, as that has
// it.

#include <cstdint>

#include "shared/render/gl_object.h"
#include "shared/render/render_target.h"

namespace lararium::render {

class PictureCopy {
 public:
  // What OpenGL calls textures that hold pictures as they are: sRGB-encoded, 8 bits. The first is
  // known for that; the second is where there is no such.
  static constexpr int64_t kEncodedFormat = 0x8C43;  // GL_SRGB8_ALPHA8
  static constexpr int64_t kPlainFormat = 0x8058;    // GL_RGBA8

  // texture: two-dimensional, of the picture's size and one of the formats. Its lowest row is
  // stored first, as OpenGL has it.
  void Into(uint32_t texture, const RenderTarget& picture) const;

 private:
  GlFramebuffer framebuffer_ = GlFramebuffer::Generate();
};

}  // namespace lararium::render
