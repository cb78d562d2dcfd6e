#pragma once

// A triangle mesh on the GPU: positions only, attribute 0. Private to render.

#include "shared/geometry/triangle_mesh.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/passes/screen_bounds.h"

namespace lararium::render {

struct GpuMesh {
  GlVertexArray vertex_array;
  GlBuffer vertices;
  GlBuffer indices;
  int index_count = 0;
  Box box;  // bounds of all positions

  static GpuMesh Create(const geometry::TriangleMesh& mesh);
  void Draw() const;
};

}  // namespace lararium::render
