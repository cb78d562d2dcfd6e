#pragma once

// Applies weighted morph targets to the vertices of a mesh.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/human.h"

namespace lararium::human {

// The morph targets that move a mesh. They point into the human, which must outlive them.
struct MeshMorphs {
  struct Entry {
    uint32_t morph = 0;  // index into Human::morphs
    const MorphTarget::Part* part = nullptr;
  };
  uint32_t mesh = 0;  // index into Human::meshes
  std::vector<Entry> entries;

  // True if a target of this mesh has a weight that is large enough to be visible.
  bool Active(std::span<const float> weights) const;
};

// Returns one entry for each mesh that targets move, in the order of the meshes.
std::vector<MeshMorphs> FindMeshMorphs(const Human& human);

// Computes the bind pose plus weighted displacements; normals are renormalised. Allocates nothing.
// Jobs with disjoint outputs may run in parallel.
struct MorphJob {
  const SkinnedMesh& mesh;
  const MeshMorphs& morphs;        // must belong to `mesh`
  std::span<const float> weights;  // one for each of Human::morphs
  std::span<glm::vec3> positions;  // Output, one for each vertex: metres, actor frame.
  std::span<glm::vec3> normals;    // Output, one for each vertex.

  void Run() const;
};

}  // namespace lararium::human
