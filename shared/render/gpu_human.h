#pragma once

// A person's skinned meshes on the GPU, in the bind pose. Private to render.

#include <vector>

#include "shared/human/human.h"
#include "shared/render/gl_object.h"
#include "shared/render/screen_bounds.h"

namespace lararium::render {

struct GpuHuman {
  struct Part {
    GlVertexArray vertex_array;
    GlBuffer vertices;
    GlBuffer indices;
    int index_count = 0;
    bool closed = false;  // back faces are never seen
  };
  std::vector<Part> parts;
  // Of each joint: the box, in the bind pose, of all vertices that follow it. A
  // posed vertex lies in the convex hull of its joints' posed boxes.
  std::vector<Box> joint_boxes;

  size_t joint_count() const { return joint_boxes.size(); }

  static GpuHuman Create(const human::Human& human);
  // Attributes as in shaders/pass/human.vert.
  void Draw() const;
};

}  // namespace lararium::render
