#pragma once

// The pose that a scene's meshes were bound in, which need not be the one its nodes rest in.

#include <glm/mat4x4.hpp>
#include <vector>

#include "editor/import/model_scene.h"

namespace lararium::import {

struct BindPose {
  std::vector<glm::mat4> scene_from_node;       // of every node, finite
  std::vector<std::vector<int>> nodes_of_mesh;  // of each mesh of the scene: its bones' nodes
};

// Of each bone by its offset matrix. A mesh says where its bones were against one another
// when it was bound; where the whole was, its topmost bone at rest tells. The meshes with
// most bones have the first word. What no mesh binds hangs on its parent as at rest.
// Errors: a bone that is not in the scene, or nowhere in space.
Result<BindPose> FindBindPose(const ModelScene& model);

}  // namespace lararium::import
