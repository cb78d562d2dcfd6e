#include "shared/render/passes/upscaler.h"

#include <epoxy/gl.h>

#include <glm/vec2.hpp>
#include <opencv2/imgproc.hpp>

#include "shared/render/gl/graphics_context.h"

namespace lararium::render {

Result<Upscaler> Upscaler::Create(Way way) {
  Upscaler upscaler;
  upscaler.way_ = way;
  if (way == Way::kShaders) {
    LARARIUM_ASSIGN_OR_RETURN(upscaler.shaders_,
                              ShaderProgram::Create("full_screen.vert", "upscale.frag"));
    upscaler.no_vertices_ = GlVertexArray::Generate();
  }
  return upscaler;
}

Result<Upscaler> Upscaler::Create() {
  return Create(DrawsOnProcessor(GraphicsDeviceName()) ? Way::kProcessor : Way::kShaders);
}

void Upscaler::Upscale(const RenderTarget& picture, const RenderTarget& target) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
  glViewport(0, 0, target.width(), target.height());
  if (way_ == Way::kShaders) {
    ByShaders(picture, target);
  } else {
    ByProcessor(picture, target);
  }
}

void Upscaler::ByShaders(const RenderTarget& picture, const RenderTarget& target) const {
  shaders_.Use();
  shaders_.Set("target_size", glm::vec2(target.width(), target.height()));
  shaders_.Set("picture", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, picture.texture());
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

void Upscaler::ByProcessor(const RenderTarget& picture, const RenderTarget& target) {
  picture_.create(picture.height(), picture.width(), CV_8UC4);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture.framebuffer());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, 0);
  glReadPixels(0, 0, picture_.cols, picture_.rows, GL_RGBA, GL_UNSIGNED_BYTE, picture_.data);
  const cv::Size size(target.width(), target.height());
  cv::resize(picture_, upscaled_, size, 0.0, 0.0, cv::INTER_LINEAR);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, target.texture());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, GL_RGBA, GL_UNSIGNED_BYTE,
                  upscaled_.data);
}

}  // namespace lararium::render
