#include "shared/render/gl/render_target.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace lararium::render {

Result<RenderTarget> RenderTarget::Create(int width, int height, Depth depth) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  if (width < 1 || height < 1 || width > most || height > most) {
    return Status::Error("graphics",
                         "cannot draw pictures of " + std::to_string(width) + "x" +
                             std::to_string(height) + " pixels",
                         "sides may have 1 to " + std::to_string(most) + " pixels");
  }
  RenderTarget target;
  target.width_ = width;
  target.height_ = height;
  target.colour_ = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_2D, target.colour_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  target.framebuffer_ = GlFramebuffer::Generate();
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.colour_.id(),
                         0);
  if (depth == Depth::kForOverlay) {
    target.depth_ = GlRenderbuffer::Generate();
    glBindRenderbuffer(GL_RENDERBUFFER, target.depth_.id());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                              target.depth_.id());
  }
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    return Status::Error("graphics", "the driver cannot draw into images of this size",
                         "try a smaller size");
  }
  return target;
}

void RenderTarget::Finish() { glFinish(); }

void RenderTarget::ReadPixels(cv::Mat& bgr) const {
  read_.create(height_, width_, CV_8UC4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, read_.data);
  cv::cvtColor(read_, bgr, cv::COLOR_RGBA2BGR);
}

void RenderTarget::Present(int framebuffer_width, int framebuffer_height) const {
  const double scale = std::min(static_cast<double>(framebuffer_width) / width_,
                                static_cast<double>(framebuffer_height) / height_);
  const int shown_width = static_cast<int>(std::lround(scale * width_));
  const int shown_height = static_cast<int>(std::lround(scale * height_));
  const int left = (framebuffer_width - shown_width) / 2;
  const int bottom = (framebuffer_height - shown_height) / 2;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glViewport(0, 0, framebuffer_width, framebuffer_height);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  // Flips the picture, because its top row is stored first.
  glBlitFramebuffer(0, height_, width_, 0, left, bottom, left + shown_width, bottom + shown_height,
                    GL_COLOR_BUFFER_BIT, GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void RenderTarget::CopyTo(uint32_t framebuffer, int x, int y) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBlitFramebuffer(0, height_, width_, 0, x, y, x + width_, y + height_, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

}  // namespace lararium::render
