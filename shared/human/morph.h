#pragma once

// The vertices of a mesh under weighted morph targets.

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "shared/human/human.h"

namespace lararium::human {

// Which morph targets move a mesh: found once for a human, which it borrows.
struct MeshMorphs {
  struct Entry {
    uint32_t morph = 0;  // index into Human::morphs
    const MorphTarget::Part* part = nullptr;
  };
  uint32_t mesh = 0;  // index into Human::meshes
  std::vector<Entry> entries;

  // True when a target of this mesh has a weight that can be seen.
  bool Active(std::span<const float> weights) const;
};

// In the order of the meshes; those that no target moves are left out.
std::vector<MeshMorphs> FindMeshMorphs(const Human& human);

// The bind pose plus weighted displacements; normals are renormalised. Allocates
// nothing; jobs with disjoint outputs may run together.
struct MorphJob {
  const SkinnedMesh& mesh;
  const MeshMorphs& morphs;        // of that mesh
  std::span<const float> weights;  // one for each of Human::morphs
  std::span<glm::vec3> positions;  // one for each vertex, metres, actor frame; overwritten
  std::span<glm::vec3> normals;    // likewise

  void Run() const;
};

}  // namespace lararium::human
