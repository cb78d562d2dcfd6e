#pragma once

// The meshes of a scene as its nodes show them, in the bind pose.

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "editor/import/model_bind_pose.h"
#include "editor/import/model_scene.h"

namespace lararium::import {

struct Influence {
  int node = SceneNodes::kNoParent;
  float weight = 0.0f;
};
using Influences = std::array<Influence, 4>;

// A mesh as one node shows it; axes and units of the scene. Arrays are parallel over its
// vertices.
struct Part {
  const aiMesh* mesh = nullptr;
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;      // of any length
  std::vector<Influences> influences;  // the strongest first; sum 1
  std::vector<glm::mat3> turns;        // scene_from_mesh of directions; only with morph targets
  bool mirrored = false;               // its triangles are to be turned over
};

// Each mesh skinned linearly to the bind pose: exact where all bones of a mesh agree on
// where it is, and the best there is where it was bound in another pose. What has no skin,
// and vertices that no weight holds, are fixed to one node. Errors: no mesh, too many
// vertices, weights or vertices that are no numbers, a skin that leaves most vertices out.
Result<std::vector<Part>> GatherParts(const ModelScene& model, const BindPose& bind);

}  // namespace lararium::import
