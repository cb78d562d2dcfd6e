#include "shared/render/gl/linear_target.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <opencv2/core.hpp>

#include "shared/render/gl/gl_object.h"

namespace lararium::render {
namespace {

// Returns the largest number of samples. OpenGL ES reports it for each format and guarantees none
// for floats.
int MostSamples() {
  GLint most = 1;
  if (epoxy_is_desktop_gl()) {
    glGetIntegerv(GL_MAX_SAMPLES, &most);
  } else {
    glGetInternalformativ(GL_RENDERBUFFER, GL_RGBA16F, GL_SAMPLES, 1, &most);
  }
  return std::max(most, 1);
}

}  // namespace

Status LinearTarget::Prepare(const ImageSize& size, int samples) {
  samples = std::clamp(samples, 1, MostSamples());
  const bool resized = size != size_;
  if (!resized && samples == samples_) {
    return Status();
  }
  size_ = size;
  samples_ = samples;
  FreeSampled();  // frees memory before more is allocated
  if (resized) {
    LARARIUM_RETURN_IF_ERROR(AllocateResolved());
  }
  return sampled() ? AllocateSampled() : Status();
}

Status LinearTarget::AllocateResolved() {
  resolved_ = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_2D, resolved_.id());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, size_.width, size_.height, 0, GL_RGBA, GL_HALF_FLOAT,
               nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  resolved_depth_ = GlRenderbuffer::Generate();
  glBindRenderbuffer(GL_RENDERBUFFER, resolved_depth_.id());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, size_.width, size_.height);
  resolved_framebuffer_ = GlFramebuffer::Generate();
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_framebuffer_.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, resolved_.id(), 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                            resolved_depth_.id());
  return CheckFramebuffer("into 16-bit float images");
}

Status LinearTarget::AllocateSampled() {
  framebuffer_ = GlFramebuffer::Generate();
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
  colour_ = GlRenderbuffer::Generate();
  glBindRenderbuffer(GL_RENDERBUFFER, colour_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_RGBA16F, size_.width,
                                   size_.height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.id());
  depth_ = GlRenderbuffer::Generate();
  glBindRenderbuffer(GL_RENDERBUFFER, depth_.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_DEPTH_COMPONENT24, size_.width,
                                   size_.height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.id());
  return CheckFramebuffer("into 16-bit float images");
}

void LinearTarget::FreeSampled() {
  colour_ = {};
  depth_ = {};
  framebuffer_ = {};
}

void LinearTarget::BindAndClear(const PixelBounds& bounds) const {
  glBindFramebuffer(GL_FRAMEBUFFER, sampled() ? framebuffer_.id() : resolved_framebuffer_.id());
  glViewport(0, 0, size_.width, size_.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(bounds.left, bounds.bottom, bounds.width(), bounds.height());
  glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  glClearDepthf(1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void LinearTarget::Resolve(const PixelBounds& b) const {
  glDisable(GL_SCISSOR_TEST);
  if (!sampled()) {
    return;
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_framebuffer_.id());
  glBlitFramebuffer(b.left, b.bottom, b.right, b.top, b.left, b.bottom, b.right, b.top,
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void LinearTarget::ReadPixels(const PixelBounds& b, cv::Mat& rgba) const {
  rgba.create(size_.height, size_.width, CV_32FC4);
  rgba.setTo(cv::Scalar::all(0.0));
  if (b.empty()) {
    return;
  }
  cv::Mat read(b.height(), b.width(), CV_32FC4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_framebuffer_.id());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glReadPixels(b.left, b.bottom, b.width(), b.height(), GL_RGBA, GL_FLOAT, read.data);
  cv::flip(read, rgba(cv::Rect(b.left, size_.height - b.top, b.width(), b.height())), 0);
}

}  // namespace lararium::render
