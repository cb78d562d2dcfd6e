#include "shared/render/gl/texture.h"

#include <epoxy/gl.h>

#include <atomic>

#include "shared/core/check.h"

namespace lararium::render {

void Texture::Upload(const cv::Mat& bgr) {
  static std::atomic<uint32_t> uploads = 0;
  version_ = ++uploads;
  CHECK(bgr.type() == CV_8UC3 && !bgr.empty() && bgr.step % 3 == 0);
  const bool fresh = texture_.id() == 0;
  if (fresh) {
    texture_ = GlTexture::Generate();
  }
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(bgr.step / 3));
  if (bgr.cols != width_ || bgr.rows != height_) {
    width_ = bgr.cols;
    height_ = bgr.rows;
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width_, height_, 0, GL_RGB, GL_UNSIGNED_BYTE, bgr.data);
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, bgr.data);
  }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  if (fresh) {
    // The image is BGR, which OpenGL ES cannot upload: swap red and blue when the texture is read.
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_R, GL_BLUE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_B, GL_RED);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
}

}  // namespace lararium::render
