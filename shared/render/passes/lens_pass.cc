#include "shared/render/passes/lens_pass.h"

#include <epoxy/gl.h>

#include <array>
#include <glm/gtc/type_ptr.hpp>

namespace lararium::render {

Result<LensPass> LensPass::Create() {
  LensPass pass;
  LARARIUM_ASSIGN_OR_RETURN(pass.program_, ShaderProgram::Create("full_screen.vert", "lens.frag"));
  return pass;
}

void LensPass::Draw(const RenderTarget& picture,
                    const LensView& view,
                    int left,
                    const RenderTarget& panel) const {
  const geometry::LensModel& lens = view.lens;
  std::array<glm::vec3, 3> radial;
  for (size_t colour = 0; colour < radial.size(); ++colour) {
    const geometry::LensModel::Radial& k = lens.radial[colour];
    radial[colour] = glm::vec3(k[0], k[1], k[2]);
  }
  const Eigen::Matrix3f picture_from_eye = view.picture_from_eye.cast<float>();
  glBindFramebuffer(GL_FRAMEBUFFER, panel.framebuffer());
  glViewport(left, 0, lens.width, lens.height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  program_.Use();
  program_.Set("lens_intrinsics", glm::vec4(lens.fx, lens.fy, lens.cx, lens.cy));
  program_.Set("radial", std::span<const glm::vec3>(radial));
  const bool has_fringes = lens.radial[0] != lens.radial[1] || lens.radial[2] != lens.radial[1];
  program_.Set("has_fringes", has_fringes ? 1 : 0);
  program_.Set("picture_from_eye", glm::make_mat3(picture_from_eye.data()));
  program_.Set("corner_px", glm::vec2(left, 0.0f));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, picture.texture());
  program_.Set("picture", 0);
  glBindVertexArray(no_vertices_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

}  // namespace lararium::render
