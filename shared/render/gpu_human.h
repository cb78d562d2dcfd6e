#pragma once

// A person's skinned meshes on the GPU, in the bind pose. Private to render.

#include <vector>

#include "shared/human/human.h"
#include "shared/render/gl_object.h"

namespace lararium::render {

struct GpuHuman {
  struct Part {
    GlVertexArray vertex_array;
    GlBuffer vertices;
    GlBuffer indices;
    int index_count = 0;
  };
  std::vector<Part> parts;
  size_t joint_count = 0;

  static GpuHuman Create(const human::Human& human);
  // Attributes as in shaders/pass/human.vert.
  void Draw() const;
};

}  // namespace lararium::render
