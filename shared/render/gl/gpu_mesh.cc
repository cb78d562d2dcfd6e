#include "shared/render/gl/gpu_mesh.h"

#include <epoxy/gl.h>

namespace lararium::render {

GpuMesh GpuMesh::Create(const geometry::TriangleMesh& mesh) {
  GpuMesh gpu;
  gpu.vertex_array = GlVertexArray::Generate();
  gpu.vertices = GlBuffer::Generate();
  gpu.indices = GlBuffer::Generate();
  gpu.index_count = static_cast<int>(mesh.indices.size());
  for (const glm::vec3& position : mesh.positions) {
    gpu.box.Extend(position);
  }
  glBindVertexArray(gpu.vertex_array.id());
  glBindBuffer(GL_ARRAY_BUFFER, gpu.vertices.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.positions.size() * sizeof(glm::vec3)),
               mesh.positions.data(), GL_STATIC_DRAW);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  glEnableVertexAttribArray(0);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, gpu.indices.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(uint32_t)), mesh.indices.data(),
               GL_STATIC_DRAW);
  glBindVertexArray(0);
  return gpu;
}

void GpuMesh::Draw() const {
  glBindVertexArray(vertex_array.id());
  glDrawElements(GL_TRIANGLES, index_count, GL_UNSIGNED_INT, nullptr);
}

}  // namespace lararium::render
