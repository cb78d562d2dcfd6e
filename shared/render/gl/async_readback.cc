#include "shared/render/gl/async_readback.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace lararium::render {
namespace {

constexpr int kBytesPerPixel = 4;

}  // namespace

AsyncReadback::~AsyncReadback() {
  if (fence_ != nullptr) {
    glDeleteSync(static_cast<GLsync>(fence_));
  }
}

void AsyncReadback::MakeLevels(int width, int height) {
  width_ = width;
  height_ = height;
  levels_.clear();
  do {
    // Halving averages four pixels into one, so that no pixel is skipped.
    if (width > most_width_) {
      width = (width + 1) / 2;
      height = std::max((height + 1) / 2, 1);
    }
    Level level = {width, height, GlTexture::Generate(), GlFramebuffer::Generate()};
    glBindTexture(GL_TEXTURE_2D, level.texture.id());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, level.framebuffer.id());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, level.texture.id(),
                           0);
    levels_.push_back(std::move(level));
  } while (width > most_width_);
  buffer_ = GlBuffer::Generate();
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.id());
  glBufferData(GL_PIXEL_PACK_BUFFER, GLsizeiptr{kBytesPerPixel} * width * height, nullptr,
               GL_STREAM_READ);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void AsyncReadback::Begin(const RenderTarget& picture) {
  if (under_way()) {
    return;
  }
  if (picture.width() != width_ || picture.height() != height_) {
    MakeLevels(picture.width(), picture.height());
  }
  step_ = 0;
  Halve(picture.framebuffer(), width_, height_, levels_.front());
}

void AsyncReadback::Halve(uint32_t from, int width, int height, const Level& level) {
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, level.framebuffer.id());
  glBlitFramebuffer(0, 0, width, height, 0, 0, level.width, level.height, GL_COLOR_BUFFER_BIT,
                    GL_LINEAR);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void AsyncReadback::Prepare(const RenderTarget& picture) {
  Begin(picture);
  cv::Mat unused;
  do {
    glFinish();
  } while (under_way() && !TryFinish(unused));
}

bool AsyncReadback::StepIsDone() {
  const auto fence = static_cast<GLsync>(fence_);
  if (fence == nullptr || glClientWaitSync(fence, 0, 0) == GL_TIMEOUT_EXPIRED) {
    return false;
  }
  glDeleteSync(fence);
  fence_ = nullptr;
  return true;
}

void AsyncReadback::BeginReading() {
  const Level& last = levels_.back();
  glBindFramebuffer(GL_READ_FRAMEBUFFER, last.framebuffer.id());
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, kBytesPerPixel);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glReadPixels(0, 0, last.width, last.height, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

bool AsyncReadback::TryFinish(cv::Mat& rgba) {
  if (!StepIsDone()) {
    return false;
  }
  // Only one step per call: with a software renderer a further step would wait for this one.
  ++step_;
  if (step_ < levels_.size()) {
    const Level& finer = levels_[step_ - 1];
    Halve(finer.framebuffer.id(), finer.width, finer.height, levels_[step_]);
    return false;
  }
  if (step_ == levels_.size()) {
    BeginReading();
    return false;
  }
  const Level& last = levels_.back();
  const size_t bytes = size_t{kBytesPerPixel} * last.width * last.height;
  glBindBuffer(GL_PIXEL_PACK_BUFFER, buffer_.id());
  const void* mapped =
      glMapBufferRange(GL_PIXEL_PACK_BUFFER, 0, static_cast<GLsizeiptr>(bytes), GL_MAP_READ_BIT);
  if (mapped != nullptr) {
    rgba = cv::Mat(last.height, last.width, CV_8UC4);
    std::memcpy(rgba.data, mapped, bytes);
    glUnmapBuffer(GL_PIXEL_PACK_BUFFER);
  }
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  return mapped != nullptr;
}

}  // namespace lararium::render
