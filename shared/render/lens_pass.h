#pragma once

// Bends a picture so that it looks straight through the lenses of a head-mounted display.

#include <Eigen/Core>

#include "shared/core/status.h"
#include "shared/geometry/lens_model.h"
#include "shared/render/gl_object.h"
#include "shared/render/render_target.h"
#include "shared/render/shader_program.h"

namespace lararium::render {

// What one eye sees, and through what.
struct LensView {
  geometry::LensModel lens;
  // Homogeneous: of a point (x, y, 1) before the eye the picture's pixel.
  Eigen::Matrix3d picture_from_eye = Eigen::Matrix3d::Identity();
};

class LensPass {
 public:
  static Result<LensPass> Create();

  // Fills the lens's part of the panel, from its column left on; black where the picture ends.
  void Draw(const RenderTarget& picture,
            const LensView& view,
            int left,
            const RenderTarget& panel) const;

 private:
  ShaderProgram program_;
  GlVertexArray no_vertices_ = GlVertexArray::Generate();
};

}  // namespace lararium::render
