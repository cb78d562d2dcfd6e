#pragma once

// Collects the meshes of a scene in the bind pose, one part for each node that refers to a
// mesh.

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "editor/import/model/model_bind_pose.h"
#include "editor/import/model/model_scene.h"

namespace lararium::import {

struct Influence {
  int node = SceneNodes::kNoParent;
  float weight = 0.0f;
};
using Influences = std::array<Influence, 4>;

// A mesh at one node, in the axes and units of the scene. The arrays are parallel over its
// vertices.
struct Part {
  const aiMesh* mesh = nullptr;
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;      // Not normalised.
  std::vector<Influences> influences;  // The strongest first; their weights sum to 1.
  std::vector<glm::mat3> turns;  // scene_from_mesh for directions; only if there are morph targets.
  size_t cut_skins = 0;   // Number of vertices that lost weight, because they had more bones.
  bool mirrored = false;  // The order of the corners of its triangles must be reversed.
};

// Skins each mesh linearly to the bind pose. This is exact if all bones of a mesh agree on its
// position, and the best approximation if it was bound in another pose. Meshes without a skin,
// and vertices without weights, are fixed to one node. Errors: no mesh, too many vertices,
// weights or vertices that are not finite, a skin without weights for most vertices.
Result<std::vector<Part>> GatherParts(const ModelScene& model, const BindPose& bind);

}  // namespace lararium::import
