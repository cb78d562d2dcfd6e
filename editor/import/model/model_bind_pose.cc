#include "editor/import/model/model_bind_pose.h"

#include <algorithm>
#include <glm/matrix.hpp>
#include <numeric>

#include "editor/import/model/model_matrix.h"
#include "shared/human/finite.h"

namespace lararium::import {
namespace {

Result<std::vector<int>> NodesOf(const aiMesh& mesh, const ModelScene& model) {
  std::vector<int> nodes;
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    nodes.push_back(model.nodes.Find(mesh.mBones[b]->mName));
    if (nodes.back() == SceneNodes::kNoParent) {
      return Status::Error(model.place(), std::string("bone '") + mesh.mBones[b]->mName.C_Str() +
                                              "' is not in the scene");
    }
  }
  return nodes;
}

// Collects the bind poses of the nodes while meshes are processed one by one.
class Binder {
 public:
  explicit Binder(const SceneNodes& nodes)
      : nodes_(nodes), rest_(nodes.size()), known_(nodes.size(), false) {
    nodes_.Globals(nodes_.local, rest_);
    bind_ = rest_;
  }

  void Add(const aiMesh& mesh, const std::vector<int>& bones) {
    const glm::mat4 scene_from_mesh = SceneFromMesh(mesh, bones);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const auto n = static_cast<size_t>(bones[b]);
      const glm::mat4 bone_from_mesh = ToGlm(mesh.mBones[b]->mOffsetMatrix);
      if (!known_[n] && IsUsable(bone_from_mesh)) {
        bind_[n] = scene_from_mesh * glm::inverse(bone_from_mesh);
        known_[n] = true;
      }
    }
  }

  std::vector<glm::mat4> Finish() {
    for (size_t n = 0; n < nodes_.size(); ++n) {
      if (!known_[n] && nodes_.parents[n] != SceneNodes::kNoParent) {
        bind_[n] = bind_[static_cast<size_t>(nodes_.parents[n])] * nodes_.local[n];
      }
    }
    return std::move(bind_);
  }

 private:
  // Uses the most informative bone: one whose pose is known, otherwise the topmost.
  glm::mat4 SceneFromMesh(const aiMesh& mesh, const std::vector<int>& bones) const {
    int anchor = SceneNodes::kNoParent;
    glm::mat4 scene_from_mesh(1.0f);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const glm::mat4 bone_from_mesh = ToGlm(mesh.mBones[b]->mOffsetMatrix);
      const auto n = static_cast<size_t>(bones[b]);
      if (IsUsable(bone_from_mesh) && IsBetter(bones[b], anchor)) {
        anchor = bones[b];
        scene_from_mesh = (known_[n] ? bind_[n] : rest_[n]) * bone_from_mesh;
      }
    }
    return scene_from_mesh;
  }

  bool IsBetter(int node, int anchor) const {
    if (anchor == SceneNodes::kNoParent) {
      return true;
    }
    const bool known = known_[static_cast<size_t>(node)];
    return known == known_[static_cast<size_t>(anchor)] ? node < anchor : known;
  }

  const SceneNodes& nodes_;
  std::vector<glm::mat4> rest_, bind_;  // scene_from_node of the nodes at rest, and of the skins.
  std::vector<bool> known_;             // Says for each node whether a skin has set `bind_`.
};

}  // namespace

Result<BindPose> FindBindPose(const ModelScene& model, bool at_rest) {
  const aiScene& scene = *model.scene;
  BindPose pose;
  pose.nodes_of_mesh.resize(scene.mNumMeshes);
  std::vector<unsigned> order(scene.mNumMeshes);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](unsigned a, unsigned b) {
    return scene.mMeshes[a]->mNumBones > scene.mMeshes[b]->mNumBones;
  });
  Binder binder(model.nodes);
  for (const unsigned m : order) {
    const aiMesh& mesh = *scene.mMeshes[m];
    LARARIUM_ASSIGN_OR_RETURN(pose.nodes_of_mesh[m], NodesOf(mesh, model));
    if (!at_rest) {
      binder.Add(mesh, pose.nodes_of_mesh[m]);
    }
  }
  pose.scene_from_node = binder.Finish();
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    if (!human::Finite(pose.scene_from_node[n])) {
      return Status::Error(model.place(),
                           "bone '" + model.nodes.names[n] + "' has no valid position",
                           "export the figure again");
    }
  }
  return pose;
}

}  // namespace lararium::import
