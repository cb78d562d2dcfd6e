#include "shared/render/gpu_human.h"

#include <epoxy/gl.h>

#include <cstddef>

#include "shared/render/closed_surface.h"

namespace lararium::render {
namespace {

struct Vertex {
  glm::vec3 position;
  glm::vec3 normal;
  glm::vec3 albedo;
  std::array<uint8_t, 4> joints;
  glm::vec4 weights;
};

std::vector<Vertex> Interleave(const human::SkinnedMesh& mesh) {
  std::vector<Vertex> vertices(mesh.positions.size());
  for (size_t i = 0; i < vertices.size(); ++i) {
    vertices[i] = {mesh.positions[i], mesh.normals[i], mesh.albedo[i], mesh.joints[i],
                   mesh.weights[i]};
  }
  return vertices;
}

void DefineFloats(GLuint location, int count, size_t offset) {
  glVertexAttribPointer(location, count, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                        reinterpret_cast<const void*>(offset));
  glEnableVertexAttribArray(location);
}

GpuHuman::Part CreatePart(const human::SkinnedMesh& mesh) {
  GpuHuman::Part part;
  part.vertex_array = GlVertexArray::Generate();
  part.vertices = GlBuffer::Generate();
  part.indices = GlBuffer::Generate();
  part.index_count = static_cast<int>(mesh.indices.size());
  part.closed = IsClosedSurface(mesh.positions, mesh.indices);
  glBindVertexArray(part.vertex_array.id());
  const std::vector<Vertex> vertices = Interleave(mesh);
  glBindBuffer(GL_ARRAY_BUFFER, part.vertices.id());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
               vertices.data(), GL_STATIC_DRAW);
  DefineFloats(0, 3, offsetof(Vertex, position));
  DefineFloats(1, 3, offsetof(Vertex, normal));
  DefineFloats(2, 3, offsetof(Vertex, albedo));
  glVertexAttribIPointer(3, 4, GL_UNSIGNED_BYTE, sizeof(Vertex),
                         reinterpret_cast<const void*>(offsetof(Vertex, joints)));
  glEnableVertexAttribArray(3);
  DefineFloats(4, 4, offsetof(Vertex, weights));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, part.indices.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(uint32_t)), mesh.indices.data(),
               GL_STATIC_DRAW);
  glBindVertexArray(0);
  return part;
}

void ExtendJointBoxes(const human::SkinnedMesh& mesh, std::vector<Box>& boxes) {
  for (size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    for (int i = 0; i < 4; ++i) {
      if (mesh.weights[vertex][i] > 0.0f) {
        boxes[mesh.joints[vertex][i]].Extend(mesh.positions[vertex]);
      }
    }
  }
}

}  // namespace

GpuHuman GpuHuman::Create(const human::Human& human) {
  GpuHuman gpu;
  gpu.joint_boxes.resize(human.skeleton.size());
  for (const human::SkinnedMesh& mesh : human.meshes) {
    gpu.parts.push_back(CreatePart(mesh));
    ExtendJointBoxes(mesh, gpu.joint_boxes);
  }
  return gpu;
}

void GpuHuman::Draw() const {
  for (const Part& part : parts) {
    if (part.closed) {
      glEnable(GL_CULL_FACE);
    } else {
      glDisable(GL_CULL_FACE);
    }
    glBindVertexArray(part.vertex_array.id());
    glDrawElements(GL_TRIANGLES, part.index_count, GL_UNSIGNED_INT, nullptr);
  }
  glDisable(GL_CULL_FACE);
}

}  // namespace lararium::render
