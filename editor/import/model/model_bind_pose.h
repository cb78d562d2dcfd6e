#pragma once

// Finds the pose in which the meshes of a scene were bound; it may differ from the rest pose of
// the nodes.

#include <algorithm>
#include <glm/mat4x4.hpp>
#include <vector>

#include "editor/import/model/model_scene.h"

namespace lararium::import {

struct BindPose {
  std::vector<glm::mat4> scene_from_node;  // Finite, for every node.
  // For each mesh of the scene, the nodes of its bones.
  std::vector<std::vector<int>> nodes_of_mesh;

  bool HasSkin() const {
    return std::any_of(nodes_of_mesh.begin(), nodes_of_mesh.end(),
                       [](const std::vector<int>& nodes) { return !nodes.empty(); });
  }
};

// Computes the pose of each bone from its offset matrix. A mesh gives the positions of its
// bones relative to one another; the rest pose of its topmost bone gives the position of the
// whole. Meshes with more bones have priority. Bones that no mesh binds keep their rest pose
// relative to the parent. Errors: a bone that is not in the scene, or has no finite position.
// `at_rest`: nodes keep their rest pose, and only the bones of the meshes are found.
Result<BindPose> FindBindPose(const ModelScene& model, bool at_rest = false);

}  // namespace lararium::import
