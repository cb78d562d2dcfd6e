#include "shared/render/gl/texture.h"

#include <epoxy/gl.h>

#include <atomic>

#include "shared/core/check.h"
#include "shared/render/gl/channel_order.h"

namespace lararium::render {

void Texture::Upload(const cv::Mat& bgr) {
  static std::atomic<uint32_t> uploads = 0;
  version_ = ++uploads;
  const bool bytes = bgr.type() == CV_8UC3;
  CHECK((bytes || bgr.type() == CV_32FC4) && !bgr.empty() && bgr.step % bgr.elemSize() == 0);
  const GLenum format = bytes ? GL_RGB : GL_RGBA;
  const GLenum type = bytes ? GL_UNSIGNED_BYTE : GL_FLOAT;
  const bool fresh = texture_.id() == 0;
  if (fresh) {
    texture_ = GlTexture::Generate();
  }
  const cv::Mat image = InUploadOrder(bgr);
  glBindTexture(GL_TEXTURE_2D, texture_.id());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(image.step / image.elemSize()));
  if (bgr.cols != width_ || bgr.rows != height_) {
    width_ = bgr.cols;
    height_ = bgr.rows;
    glTexImage2D(GL_TEXTURE_2D, 0, bytes ? GL_RGB8 : GL_RGBA16F, width_, height_, 0, format, type,
                 image.data);
  } else {
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, format, type, image.data);
  }
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  if (fresh) {
    SwapRedAndBlueIfNeeded();
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
}

}  // namespace lararium::render
