#include "shared/render/passes/sun_mask.h"

#include <epoxy/gl.h>

#include "shared/render/gl/gl_object.h"

namespace lararium::render {
namespace {

constexpr int kDepthUnit = 0;

GlTexture AllocateImage(
    GLint internal, const ImageSize& size, GLenum format, GLenum type, GLenum attachment) {
  GlTexture texture = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, internal, size.width, size.height, 0, format, type, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, texture.id(), 0);
  return texture;
}

}  // namespace

Result<SunMask> SunMask::Create() {
  SunMask mask;
  LARARIUM_ASSIGN_OR_RETURN(mask.shaders_,
                            ShaderProgram::Create("full_screen.vert", "sun_seen.frag"));
  mask.no_vertices_ = GlVertexArray::Generate();
  return mask;
}

Status SunMask::Prepare(const ImageSize& size) {
  if (size == size_) {
    return Status();
  }
  size_ = size;
  depth_framebuffer_ = GlFramebuffer::Generate();
  glBindFramebuffer(GL_FRAMEBUFFER, depth_framebuffer_.id());
  depth_ = AllocateImage(GL_DEPTH_COMPONENT24, size, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
                         GL_DEPTH_ATTACHMENT);
  const GLenum none = GL_NONE;
  glDrawBuffers(1, &none);
  glReadBuffer(GL_NONE);
  LARARIUM_RETURN_IF_ERROR(CheckFramebuffer("shadows into images"));
  seen_framebuffer_ = GlFramebuffer::Generate();
  glBindFramebuffer(GL_FRAMEBUFFER, seen_framebuffer_.id());
  seen_ = AllocateImage(GL_R8, size, GL_RED, GL_UNSIGNED_BYTE, GL_COLOR_ATTACHMENT0);
  return CheckFramebuffer("shadows into images");
}

Status SunMask::Draw(const PictureView& view,
                     const PixelBounds& bounds,
                     std::span<const ModelDraw> draws,
                     const SunPass& sun,
                     ModelPass& models) {
  if (!sun.shines() || bounds.empty()) {
    return Status();
  }
  LARARIUM_RETURN_IF_ERROR(Prepare(view.size));
  glBindFramebuffer(GL_FRAMEBUFFER, depth_framebuffer_.id());
  glViewport(0, 0, view.size.width, view.size.height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(bounds.left, bounds.bottom, bounds.width(), bounds.height());
  glEnable(GL_DEPTH_TEST);
  glClearDepthf(1.0f);
  glClear(GL_DEPTH_BUFFER_BIT);
  models.DrawDepth(view.clip_from_stage, draws);
  glDisable(GL_DEPTH_TEST);

  glBindFramebuffer(GL_FRAMEBUFFER, seen_framebuffer_.id());
  shaders_.Use();
  shaders_.Set("eye_in_stage", view.eye_in_stage);
  shaders_.Set("ray_at_corner", view.ray_at_corner);
  shaders_.Set("ray_per_column", view.ray_per_column);
  shaders_.Set("ray_per_row", view.ray_per_row);
  shaders_.Set("near_far", glm::vec2(view.near, view.far));
  shaders_.Set("last_cell", glm::ivec2(view.size.width - 1, view.size.height - 1));
  sun.BindFor(shaders_);
  glActiveTexture(GL_TEXTURE0 + kDepthUnit);
  glBindTexture(GL_TEXTURE_2D, depth_.id());
  shaders_.Set("nearest_depth", kDepthUnit);
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glDisable(GL_SCISSOR_TEST);
  return Status();
}

void SunMask::BindFor(const ShaderProgram& shaders) const {
  glActiveTexture(GL_TEXTURE0 + kUnit);
  glBindTexture(GL_TEXTURE_2D, seen_.id());
  shaders.Set("sun_seen", static_cast<int>(kUnit));
  glActiveTexture(GL_TEXTURE0);
}

}  // namespace lararium::render
