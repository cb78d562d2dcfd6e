#pragma once

// A picture made as large as another, or as small. Private to render.

#include <opencv2/core/mat.hpp>

#include "shared/core/status.h"
#include "shared/render/gl_object.h"
#include "shared/render/render_target.h"
#include "shared/render/shader_program.h"

namespace lararium::render {

class Enlarger {
 public:
  enum class Way {
    kShaders,
    // Where it draws too: it takes a third of the time, with vectors of bytes, that shaders take
    // that software runs. A graphics card would wait for it.
    kProcessor,
  };
  static Result<Enlarger> Create(Way way);
  // By whoever draws in the current context.
  static Result<Enlarger> Create();

  // Fills the target, between pixels linearly. Both ways agree to one step of 8 bits.
  void Enlarge(const RenderTarget& picture, const RenderTarget& target);

 private:
  void ByShaders(const RenderTarget& picture, const RenderTarget& target) const;
  void ByProcessor(const RenderTarget& picture, const RenderTarget& target);

  Way way_ = Way::kShaders;
  ShaderProgram shaders_;
  GlVertexArray no_vertices_;
  cv::Mat picture_;  // RGBA, kept between calls
  cv::Mat enlarged_;
};

}  // namespace lararium::render
