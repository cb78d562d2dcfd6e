#include "shared/render/passes/picture_copy.h"

#include <epoxy/gl.h>

namespace lararium::render {

static_assert(PictureCopy::kEncodedFormat == GL_SRGB8_ALPHA8);
static_assert(PictureCopy::kPlainFormat == GL_RGBA8);

void PictureCopy::Into(uint32_t texture, const RenderTarget& picture) const {
  const int width = picture.width();
  const int height = picture.height();
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture.framebuffer());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.id());
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  glDisable(GL_SCISSOR_TEST);
  // No conversion: the picture is encoded already. (OpenGL ES would encode it again.)
  glDisable(GL_FRAMEBUFFER_SRGB);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBlitFramebuffer(0, 0, width, height, 0, height, width, 0, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace lararium::render
