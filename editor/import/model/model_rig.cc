#include "editor/import/model/model_rig.h"

namespace lararium::import {
namespace {

void AddMovedNodes(const aiScene& scene, const SceneNodes& nodes, std::set<int>& bones) {
  for (unsigned i = 0; i < scene.mNumAnimations; ++i) {
    const aiAnimation& animation = *scene.mAnimations[i];
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
      bones.insert(nodes.Find(animation.mChannels[c]->mNodeName));
    }
  }
  bones.erase(SceneNodes::kNoParent);
  // The end nodes of hands and feet give the direction of these bones.
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (nodes.parents[n] != SceneNodes::kNoParent && bones.contains(nodes.parents[n])) {
      bones.insert(static_cast<int>(n));
    }
  }
}

std::set<int> BoneNodes(const ModelScene& model, const BindPose& bind, Content content) {
  std::set<int> bones;
  for (const std::vector<int>& nodes : bind.nodes_of_mesh) {
    bones.insert(nodes.begin(), nodes.end());
  }
  if (content == Content::kMotion) {
    AddMovedNodes(*model.scene, model.nodes, bones);
  }
  if (model.vrm) {
    for (const auto& [joint, node] : model.vrm->bones) {
      bones.insert(model.nodes.FindGltf(node));
    }
    for (const Vrm::Spring& spring : model.vrm->springs) {
      for (const size_t node : spring.nodes) {
        bones.insert(model.nodes.FindGltf(node));
      }
    }
  }
  bones.erase(SceneNodes::kNoParent);
  return bones;
}

// Says whether each node is a bone or an ancestor of one; in a puppet all nodes are candidates.
std::vector<bool> Candidates(const SceneNodes& nodes, const std::set<int>& bones) {
  std::vector<bool> candidate(nodes.size(), bones.empty());
  for (int node : bones) {
    for (; node != SceneNodes::kNoParent && !candidate[static_cast<size_t>(node)];
         node = nodes.parents[static_cast<size_t>(node)]) {
      candidate[static_cast<size_t>(node)] = true;
    }
  }
  return candidate;
}

// Fills in `bones` and `node_of_bone`. Returns the bone of each node, or of its nearest
// ancestor that is a bone.
std::vector<int> ListBones(const SceneNodes& nodes, const BindPose& bind, ModelRig& result) {
  const std::vector<bool> candidate = Candidates(nodes, result.bone_nodes);
  std::vector<int> bone_of_node(nodes.size(), Rig::kNoParent);
  for (size_t n = 0; n < nodes.size(); ++n) {
    const int parent = nodes.parents[n];
    const int above = parent == SceneNodes::kNoParent ? Rig::kNoParent
                                                      : bone_of_node[static_cast<size_t>(parent)];
    bone_of_node[n] = above;
    if (candidate[n] && !nodes.IsPivot(n)) {
      bone_of_node[n] = static_cast<int>(result.bones.size());
      result.bones.names.push_back(nodes.names[n]);
      result.bones.parents.push_back(above);
      result.bones.positions.emplace_back(bind.scene_from_node[n][3]);
      result.node_of_bone.push_back(static_cast<int>(n));
    }
  }
  return bone_of_node;
}

// The bones named by the file.
GivenBones VrmBones(const ModelScene& model,
                    const std::vector<int>& bone_of_node,
                    const std::vector<int>& node_of_bone) {
  GivenBones given;
  given.found_by = FoundBy::kFile;
  for (const auto& [joint, gltf_node] : model.vrm->bones) {
    const int node = model.nodes.FindGltf(gltf_node);
    const int bone =
        node == SceneNodes::kNoParent ? Rig::kNoParent : bone_of_node[static_cast<size_t>(node)];
    if (bone != Rig::kNoParent && node_of_bone[static_cast<size_t>(bone)] == node) {
      given.bones[joint] = bone;
    }
  }
  return given;
}

}  // namespace

Result<ModelRig> FindRig(const ModelScene& model,
                         const BindPose& bind,
                         Content content,
                         const BoneNames& saved,
                         std::vector<std::string>& notes) {
  ModelRig result;
  result.bone_nodes = BoneNodes(model, bind, content);
  const std::vector<int> bone_of_node = ListBones(model.nodes, bind, result);
  std::vector<GivenBones> given = {FindGiven(result.bones, saved)};
  for (const auto& [joint, bone] : saved) {
    if (!bone.empty() && !result.bones.Find(bone)) {
      notes.push_back("the bone map names '" + bone + "' for " + joint +
                      ", which the figure does not have");
    }
  }
  if (model.vrm) {
    given.push_back(VrmBones(model, bone_of_node, result.node_of_bone));
  }
  // A thing keeps axes and unit of its file, even if there are people in it. A VRM is one figure.
  if (!IsRigid(content) || model.vrm) {
    result.map = MapBones(result.bones, given);
  }
  if (!IsRigid(content) && result.bone_nodes.empty() && !result.map.IsHuman()) {
    return Status::Error(model.place(), "no part of it is bound to a skeleton",
                         "add it as an object, or export it with its armature");
  }
  return result;
}

}  // namespace lararium::import
