#pragma once

// Distorts a picture so that it looks straight through the lenses of a head-mounted display.

#include <Eigen/Core>

#include "shared/core/status.h"
#include "shared/geometry/lens_model.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/render_target.h"
#include "shared/render/gl/shader_program.h"

namespace lararium::render {

// One eye's view of a picture through its lens.
struct LensView {
  geometry::LensModel lens;
  // Homography from a point (x, y, 1) in front of the eye to a pixel of the picture.
  Eigen::Matrix3d picture_from_eye = Eigen::Matrix3d::Identity();
};

class LensPass {
 public:
  static Result<LensPass> Create();

  // Fills the lens's part of the panel, which begins at column `left`. Pixels outside the picture
  // become black.
  void Draw(const RenderTarget& picture,
            const LensView& view,
            int left,
            const RenderTarget& panel) const;

 private:
  ShaderProgram program_;
  GlVertexArray no_vertices_ = GlVertexArray::Generate();
};

}  // namespace lararium::render
