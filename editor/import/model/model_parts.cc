#include "editor/import/model/model_parts.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <map>
#include <utility>

#include "editor/import/model/model_matrix.h"
#include "shared/human/finite.h"

namespace lararium::import {
namespace {

// Keeps the four largest influences in descending order. Returns the weight that is lost.
float Insert(Influence influence, Influences& influences) {
  for (Influence& slot : influences) {
    if (influence.weight > slot.weight) {
      std::swap(influence, slot);
    }
  }
  return std::max(influence.weight, 0.0f);
}

void Normalise(int instead, Influences& influences) {
  float sum = 0.0f;
  for (const Influence& influence : influences) {
    sum += influence.weight;
  }
  if (!(sum > 1e-6f) || !std::isfinite(sum)) {
    influences = {};
    influences[0] = {instead, 1.0f};
    return;
  }
  for (Influence& influence : influences) {
    influence.weight /= sum;
  }
}

class PartGatherer {
 public:
  PartGatherer(const ModelScene& model, const BindPose& bind) : model_(model), bind_(bind) {}

  Result<std::vector<Part>> Gather() {
    for (size_t n = 0; n < model_.nodes.size(); ++n) {
      const aiNode& node = *model_.nodes.nodes[n];
      for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        LARARIUM_RETURN_IF_ERROR(GatherPart(n, node.mMeshes[i]));
      }
    }
    if (parts_.empty()) {
      return Status::Error(model_.place(), "there is no mesh of triangles in it",
                           "import it as a clip, or export it with its mesh");
    }
    return std::move(parts_);
  }

 private:
  Status GatherPart(size_t node, unsigned mesh_index) {
    const aiMesh& mesh = *model_.scene->mMeshes[mesh_index];
    vertex_count_ += mesh.mNumVertices;
    if (vertex_count_ > kMaxVertices) {
      return Status::Error(model_.place(),
                           "there are more than " + std::to_string(kMaxVertices) + " vertices",
                           "simplify the figure");
    }
    if (!mesh.HasPositions() || !mesh.HasNormals() || mesh.mNumFaces == 0) {
      return Status();
    }
    const std::vector<int>& bones = bind_.nodes_of_mesh[mesh_index];
    Part part;
    part.mesh = &mesh;
    part.name = model_.nodes.names[node];
    if (model_.nodes.nodes[node]->mNumMeshes > 1) {
      part.name += "." + std::to_string(parts_.size());
    }
    LARARIUM_RETURN_IF_ERROR(GatherWeights(static_cast<int>(node), bones, part));
    LARARIUM_RETURN_IF_ERROR(PlaceVertices(static_cast<int>(node), bones, part));
    parts_.push_back(std::move(part));
    return Status();
  }

  Status GatherWeights(int node, const std::vector<int>& bones, Part& part) const {
    const aiMesh& mesh = *part.mesh;
    part.influences.resize(mesh.mNumVertices);
    std::vector<float> lost(mesh.mNumVertices, 0.0f);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (weight.mVertexId >= mesh.mNumVertices || !std::isfinite(weight.mWeight)) {
          return Error(part, "a skin weight is not a number or names no vertex");
        }
        lost[weight.mVertexId] +=
            Insert({bones[b], weight.mWeight}, part.influences[weight.mVertexId]);
      }
    }
    part.cut_skins = static_cast<size_t>(
        std::count_if(lost.begin(), lost.end(), [](float weight) { return weight > 0.01f; }));
    const int instead = bones.empty() ? node : *std::min_element(bones.begin(), bones.end());
    size_t bare = 0;
    for (Influences& influences : part.influences) {
      bare += influences[0].weight > 0.0f ? 0 : 1;
      Normalise(instead, influences);
    }
    // Assimp silently drops weights that are not finite.
    return bones.empty() || 2 * bare < part.influences.size()
               ? Status()
               : Error(part, "most of its vertices have no skin weight");
  }

  Status PlaceVertices(int node, const std::vector<int>& bones, Part& part) const {
    const aiMesh& mesh = *part.mesh;
    const std::map<int, glm::mat4> scene_from_mesh = SceneFromMesh(node, bones, mesh);
    part.positions.reserve(mesh.mNumVertices);
    part.normals.reserve(mesh.mNumVertices);
    part.turns.reserve(mesh.mNumAnimMeshes > 0 ? mesh.mNumVertices : 0);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      glm::mat4 blended(0.0f);
      for (const Influence& influence : part.influences[v]) {
        if (influence.weight > 0.0f) {
          blended += influence.weight * scene_from_mesh.at(influence.node);
        }
      }
      const glm::vec3 position = Apply(blended, ToGlm(mesh.mVertices[v]));
      if (!human::Finite(position)) {
        return Error(part, "a vertex has no valid position");
      }
      part.positions.push_back(position);
      part.normals.push_back(glm::mat3(blended) * ToGlm(mesh.mNormals[v]));
      if (mesh.mNumAnimMeshes > 0) {
        part.turns.emplace_back(blended);
      }
      part.mirrored = part.mirrored || glm::determinant(glm::mat3(blended)) < 0.0f;
    }
    return Status();
  }

  // The pose of the mesh according to each node that moves its vertices.
  std::map<int, glm::mat4> SceneFromMesh(int node,
                                         const std::vector<int>& bones,
                                         const aiMesh& mesh) const {
    std::map<int, glm::mat4> scene_from_mesh;
    scene_from_mesh[node] = bind_.scene_from_node[static_cast<size_t>(node)];
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const glm::mat4 bone_from_mesh = ToGlm(mesh.mBones[b]->mOffsetMatrix);
      scene_from_mesh[bones[b]] = bind_.scene_from_node[static_cast<size_t>(bones[b])] *
                                  (IsUsable(bone_from_mesh) ? bone_from_mesh : glm::mat4(1.0f));
    }
    return scene_from_mesh;
  }

  Status Error(const Part& part, const std::string& problem) const {
    return Status::Error(model_.place(), "part '" + part.name + "': " + problem,
                         "export the figure again");
  }

  const ModelScene& model_;
  const BindPose& bind_;
  std::vector<Part> parts_;
  size_t vertex_count_ = 0;
};

}  // namespace

Result<std::vector<Part>> GatherParts(const ModelScene& model, const BindPose& bind) {
  return PartGatherer(model, bind).Gather();
}

}  // namespace lararium::import
