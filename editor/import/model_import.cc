#include "editor/import/model_import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "editor/import/joint_names.h"

namespace lararium::import {
namespace {

constexpr uintmax_t kMaxModelBytes = uintmax_t{1} << 30;
constexpr size_t kMaxVertices = 2'000'000;
constexpr size_t kMaxNodes = 100'000;
constexpr double kMaxClipSeconds = 3600.0;
constexpr size_t kMaxKeys = 8'000'000;  // joints times keys, in all clips

glm::vec3 ToGlm(const aiVector3D& v) { return {v.x, v.y, v.z}; }
glm::quat ToGlm(const aiQuaternion& q) { return {q.w, q.x, q.y, q.z}; }
glm::mat4 ToGlm(const aiMatrix4x4& m) {
  return glm::transpose(glm::mat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4,  //
                                  m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4));
}

// Owns the scene that it returns.
Result<const aiScene*> ReadScene(Assimp::Importer& importer, const std::filesystem::path& file) {
  std::error_code error;
  const uintmax_t size = std::filesystem::file_size(file, error);
  if (error) {
    return Status::Error(file.string(), "cannot open: " + error.message());
  }
  if (size == 0 || size > kMaxModelBytes) {
    return Status::Error(file.string(), size == 0 ? "the file is empty" : "the file is too large");
  }
  try {
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyInteger(AI_CONFIG_PP_LBW_MAX_WEIGHTS, 4);
    const aiScene* scene =
        importer.ReadFile(file.string(), aiProcess_ValidateDataStructure | aiProcess_Triangulate |
                                             aiProcess_SortByPType | aiProcess_GenSmoothNormals |
                                             aiProcess_LimitBoneWeights);
    if (scene == nullptr) {
      return Status::Error(file.string(),
                           std::string("cannot be imported: ") + importer.GetErrorString(),
                           "export it again, best as glTF 2.0");
    }
    if (scene->mRootNode == nullptr || scene->mNumMeshes == 0) {
      return Status::Error(file.string(), "there is no mesh in it");
    }
    return scene;
  } catch (const std::exception& exception) {
    return Status::Error(file.string(), std::string("cannot be imported: ") + exception.what());
  } catch (...) {
    return Status::Error(file.string(), "cannot be imported");
  }
}

// Every node, parents before children.
Result<std::vector<const aiNode*>> ListNodes(const aiScene& scene, const std::string& place) {
  std::vector<const aiNode*> nodes = {scene.mRootNode};
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes.size() + nodes[i]->mNumChildren > kMaxNodes) {
      return Status::Error(place, "there are more than " + std::to_string(kMaxNodes) + " nodes");
    }
    nodes.insert(nodes.end(), nodes[i]->mChildren, nodes[i]->mChildren + nodes[i]->mNumChildren);
  }
  return nodes;
}

glm::mat4 SceneFromNode(const aiNode* node) {
  glm::mat4 transform(1.0f);
  for (; node != nullptr; node = node->mParent) {
    transform = ToGlm(node->mTransformation) * transform;
  }
  return transform;
}

void AppendIndices(const aiMesh& mesh, uint32_t first, std::vector<uint32_t>& indices) {
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices == 3) {
      for (int k = 0; k < 3; ++k) {
        indices.push_back(first + face.mIndices[k]);
      }
    }
  }
}

// Turns a figure of the file into a human::Human.
class HumanBuilder {
 public:
  HumanBuilder(const aiScene& scene, std::string place, const ImportOptions& options)
      : scene_(scene), place_(std::move(place)), options_(options) {
    const float angle = options.faces_positive_z ? std::numbers::pi_v<float> : 0.0f;
    turn_ = glm::angleAxis(angle, glm::vec3(0.0f, 1.0f, 0.0f));
    actor_from_scene_ = glm::scale(glm::mat4_cast(turn_), glm::vec3(options.metres_per_unit));
  }

  Result<human::Human> Build() {
    LARARIUM_ASSIGN_OR_RETURN(nodes_, ListNodes(scene_, place_));
    LARARIUM_RETURN_IF_ERROR(FindJoints());
    LARARIUM_RETURN_IF_ERROR(FindBindMatrices());
    for (const aiNode* node : nodes_) {
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        LARARIUM_RETURN_IF_ERROR(AddPart(*node, *scene_.mMeshes[node->mMeshes[i]]));
      }
    }
    for (unsigned i = 0; i < scene_.mNumAnimations; ++i) {
      LARARIUM_RETURN_IF_ERROR(AddClip(*scene_.mAnimations[i]));
    }
    human_.name = options_.name;
    human_.credits = options_.credits;
    LARARIUM_RETURN_IF_ERROR(human_.Validate(place_));
    return std::move(human_);
  }

 private:
  // Joints are the nodes that move vertices and all their ancestors.
  Status FindJoints() {
    std::set<std::string> bones;
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m) {
      for (unsigned b = 0; b < scene_.mMeshes[m]->mNumBones; ++b) {
        bones.insert(scene_.mMeshes[m]->mBones[b]->mName.C_Str());
      }
    }
    if (bones.empty()) {
      return Status::Error(place_, "no part of it is bound to a skeleton",
                           "import it as a prop, or export it with its armature");
    }
    std::set<const aiNode*> needed;
    for (const aiNode* node : nodes_) {
      if (bones.contains(node->mName.C_Str())) {
        for (const aiNode* n = node; n != nullptr && needed.insert(n).second; n = n->mParent) {
        }
      }
    }
    for (const aiNode* node : nodes_) {
      if (needed.contains(node)) {
        LARARIUM_RETURN_IF_ERROR(AddJoint(*node));
      }
    }
    return Status();
  }

  Status AddJoint(const aiNode& node) {
    human::Skeleton& skeleton = human_.skeleton;
    if (skeleton.size() == human::Skeleton::kMaxJoints) {
      return Status::Error(place_, "the skeleton has more than " +
                                       std::to_string(human::Skeleton::kMaxJoints) + " joints");
    }
    const size_t index = skeleton.size();
    std::string name = HAnimName(node.mName.C_Str());
    if (name.empty() || skeleton.Find(name).has_value()) {
      name = std::string(node.mName.C_Str()) + "#" + std::to_string(index);
    }
    joint_of_node_[&node] = index;
    joint_of_name_.emplace(node.mName.C_Str(), index);
    skeleton.names.push_back(name);
    skeleton.parents.push_back(node.mParent == nullptr
                                   ? human::Skeleton::kNoParent
                                   : static_cast<int16_t>(joint_of_node_.at(node.mParent)));
    aiVector3D scale, position;
    aiQuaternion rotation;
    node.mTransformation.Decompose(scale, rotation, position);
    skeleton.rest.push_back(Local(index, {ToGlm(rotation), ToGlm(position), ToGlm(scale)}));
    return Status();
  }

  // A root's transform in the file leads to the scene; ours to the actor.
  human::JointTransform Local(size_t joint, human::JointTransform transform) const {
    transform.rotation = glm::normalize(transform.rotation);
    if (human_.skeleton.parents[joint] == human::Skeleton::kNoParent) {
      transform.rotation = turn_ * transform.rotation;
      transform.translation = glm::vec3(actor_from_scene_ * glm::vec4(transform.translation, 1.0f));
      transform.scale *= options_.metres_per_unit;
    }
    return transform;
  }

  // From the bones of the first mesh that has them, else from the rest pose.
  Status FindBindMatrices() {
    human::Skeleton& skeleton = human_.skeleton;
    std::vector<glm::mat4> actor_from_joint(skeleton.size());
    ComputeActorFromJoint(skeleton, skeleton.rest, actor_from_joint);
    for (const glm::mat4& matrix : actor_from_joint) {
      skeleton.joint_from_actor.push_back(Affine(glm::inverse(matrix)));
    }
    std::set<size_t> bound;
    for (unsigned m = 0; m < scene_.mNumMeshes; ++m) {
      for (unsigned b = 0; b < scene_.mMeshes[m]->mNumBones; ++b) {
        const aiBone& bone = *scene_.mMeshes[m]->mBones[b];
        const auto joint = joint_of_name_.find(bone.mName.C_Str());
        if (joint == joint_of_name_.end()) {
          return Status::Error(
              place_, std::string("bone '") + bone.mName.C_Str() + "' is not in the scene");
        }
        if (bound.insert(joint->second).second) {
          skeleton.joint_from_actor[joint->second] =
              Affine(ToGlm(bone.mOffsetMatrix) * glm::inverse(actor_from_scene_));
        }
      }
    }
    return Status();
  }

  static glm::mat4 Affine(glm::mat4 matrix) {
    for (int column = 0; column < 4; ++column) {
      matrix[column].w = column == 3 ? 1.0f : 0.0f;
    }
    return matrix;
  }

  Status AddPart(const aiNode& node, const aiMesh& mesh) {
    vertex_count_ += mesh.mNumVertices;
    if (vertex_count_ > kMaxVertices) {
      return Status::Error(place_,
                           "there are more than " + std::to_string(kMaxVertices) + " vertices",
                           "simplify the figure");
    }
    if (!mesh.HasPositions() || !mesh.HasNormals() || mesh.mNumFaces == 0) {
      return Status();
    }
    human::SkinnedMesh part;
    part.name = node.mNumMeshes == 1 ? node.mName.C_Str() : mesh.mName.C_Str();
    const size_t joint = NearestJoint(&node);
    LARARIUM_ASSIGN_OR_RETURN(const glm::mat4 actor_from_mesh, ActorFromMesh(node, mesh, joint));
    AddVertices(mesh, actor_from_mesh, part);
    LARARIUM_RETURN_IF_ERROR(AddWeights(mesh, joint, part));
    AppendIndices(mesh, 0, part.indices);
    if (glm::determinant(glm::mat3(actor_from_mesh)) < 0.0f) {
      for (size_t i = 0; i < part.indices.size(); i += 3) {
        std::swap(part.indices[i + 1], part.indices[i + 2]);
      }
    }
    human_.meshes.push_back(std::move(part));
    return Status();
  }

  size_t NearestJoint(const aiNode* node) const {
    while (!joint_of_node_.contains(node)) {
      node = node->mParent;  // the scene's root is a joint
    }
    return joint_of_node_.at(node);
  }

  // Takes a mesh to the bind pose. Meshes may be bound in different frames; all
  // bones of one mesh must agree on where it is.
  Result<glm::mat4> ActorFromMesh(const aiNode& node, const aiMesh& mesh, size_t joint) const {
    const human::Skeleton& skeleton = human_.skeleton;
    if (mesh.mNumBones == 0) {
      glm::mat4 joint_from_node(1.0f);
      for (const aiNode* n = &node; joint_of_node_.find(n) == joint_of_node_.end();
           n = n->mParent) {
        joint_from_node = ToGlm(n->mTransformation) * joint_from_node;
      }
      return glm::inverse(skeleton.joint_from_actor[joint]) * joint_from_node;
    }
    const auto via = [&](const aiBone& bone) {
      const size_t index = joint_of_name_.at(bone.mName.C_Str());
      return glm::inverse(skeleton.joint_from_actor[index]) * ToGlm(bone.mOffsetMatrix);
    };
    const glm::mat4 actor_from_mesh = via(*mesh.mBones[0]);
    for (unsigned b = 1; b < mesh.mNumBones; ++b) {
      const glm::mat4 other = via(*mesh.mBones[b]);
      for (int column = 0; column < 4; ++column) {
        if (!(glm::length(other[column] - actor_from_mesh[column]) < 1e-2f)) {
          return Status::Error(place_,
                               std::string("part '") + node.mName.C_Str() +
                                   "' is bound in another pose than the rest of the figure",
                               "apply one bind pose to all parts before exporting");
        }
      }
    }
    return actor_from_mesh;
  }

  glm::vec3 BaseColor(const aiMesh& mesh) const {
    aiColor4D color(0.5f, 0.5f, 0.5f, 1.0f);
    const aiMaterial* material = mesh.mMaterialIndex < scene_.mNumMaterials
                                     ? scene_.mMaterials[mesh.mMaterialIndex]
                                     : nullptr;
    if (material != nullptr && material->Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) {
      material->Get(AI_MATKEY_COLOR_DIFFUSE, color);
    }
    return {color.r, color.g, color.b};
  }

  void AddVertices(const aiMesh& mesh,
                   const glm::mat4& actor_from_mesh,
                   human::SkinnedMesh& part) const {
    const glm::vec3 base_color = BaseColor(mesh);
    const glm::mat3 normal_matrix = glm::transpose(glm::inverse(glm::mat3(actor_from_mesh)));
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const glm::vec3 normal = normal_matrix * ToGlm(mesh.mNormals[v]);
      const float length = glm::length(normal);
      glm::vec3 albedo = base_color;
      if (mesh.HasVertexColors(0)) {
        const aiColor4D& color = mesh.mColors[0][v];
        albedo *= glm::vec3(color.r, color.g, color.b);
      }
      part.positions.emplace_back(actor_from_mesh * glm::vec4(ToGlm(mesh.mVertices[v]), 1.0f));
      part.normals.push_back(length > 1e-12f ? normal / length : glm::vec3(0.0f, 1.0f, 0.0f));
      part.albedo.push_back(glm::clamp(albedo, 0.0f, 1.0f));
    }
  }

  // Vertices without weights follow the joint that the part hangs from.
  Status AddWeights(const aiMesh& mesh, size_t fallback, human::SkinnedMesh& part) const {
    const size_t count = mesh.mNumVertices;
    part.joints.assign(count, {static_cast<uint8_t>(fallback), 0, 0, 0});
    part.weights.assign(count, glm::vec4(0.0f));
    std::vector<uint8_t> used(count, 0);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      const auto joint = static_cast<uint8_t>(joint_of_name_.at(bone.mName.C_Str()));
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (weight.mVertexId >= count || !std::isfinite(weight.mWeight)) {
          return Status::Error(place_, "a skin weight names a vertex that does not exist");
        }
        uint8_t& slot = used[weight.mVertexId];
        if (weight.mWeight > 0.0f && slot < 4) {
          part.joints[weight.mVertexId][slot] = joint;
          part.weights[weight.mVertexId][slot] = weight.mWeight;
          ++slot;
        }
      }
    }
    for (glm::vec4& weights : part.weights) {
      const float sum = weights.x + weights.y + weights.z + weights.w;
      weights = sum > 0.0f ? weights / sum : glm::vec4(1.0f, 0.0f, 0.0f, 0.0f);
    }
    return Status();
  }

  Status AddClip(const aiAnimation& animation) {
    const double ticks_per_second =
        animation.mTicksPerSecond > 0.0 ? animation.mTicksPerSecond : 25.0;
    const double duration = animation.mDuration / ticks_per_second;
    if (!std::isfinite(duration) || duration < 0.0 || duration > kMaxClipSeconds) {
      return Status::Error(
          place_, std::string("clip '") + animation.mName.C_Str() + "' has an impossible duration");
    }
    const size_t joint_count = human_.skeleton.size();
    const auto intervals =
        static_cast<size_t>(std::max(1.0, std::round(duration * options_.keys_per_second)));
    key_count_ += (intervals + 1) * joint_count;
    if (key_count_ > kMaxKeys) {
      return Status::Error(place_, "the clips are too long", "split or shorten them");
    }
    human::Clip clip;
    clip.name = animation.mName.length > 0 ? animation.mName.C_Str()
                                           : "clip " + std::to_string(human_.clips.size() + 1);
    clip.duration = static_cast<float>(duration);
    clip.keys_per_second = duration > 0.0
                               ? static_cast<float>(static_cast<double>(intervals) / duration)
                               : options_.keys_per_second;
    const size_t keys = duration > 0.0 ? intervals + 1 : 1;
    for (size_t key = 0; key < keys; ++key) {
      clip.keys.insert(clip.keys.end(), human_.skeleton.rest.begin(), human_.skeleton.rest.end());
    }
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
      SampleChannel(*animation.mChannels[c], animation.mDuration, clip);
    }
    clip.loops = EndsWhereItBegins(clip);
    human_.clips.push_back(std::move(clip));
    return Status();
  }

  void SampleChannel(const aiNodeAnim& channel, double duration_ticks, human::Clip& clip) const {
    const auto joint = joint_of_name_.find(channel.mNodeName.C_Str());
    if (joint == joint_of_name_.end()) {
      return;
    }
    const size_t joint_count = human_.skeleton.size();
    const size_t keys = clip.KeyCount(joint_count);
    for (size_t key = 0; key < keys; ++key) {
      const double time =
          keys > 1 ? duration_ticks * static_cast<double>(key) / static_cast<double>(keys - 1)
                   : 0.0;
      human::JointTransform transform;
      transform.translation =
          SampleVector(channel.mPositionKeys, channel.mNumPositionKeys, time, glm::vec3(0.0f));
      transform.scale =
          SampleVector(channel.mScalingKeys, channel.mNumScalingKeys, time, glm::vec3(1.0f));
      transform.rotation = SampleRotation(channel.mRotationKeys, channel.mNumRotationKeys, time);
      clip.keys[key * joint_count + joint->second] = Local(joint->second, transform);
    }
  }

  // The keys on either side of a time and the share of the second.
  template <typename Key>
  static std::pair<const Key*, const Key*> Neighbours(const Key* keys,
                                                      unsigned count,
                                                      double time,
                                                      float& share) {
    const Key* after = std::upper_bound(keys, keys + count, time,
                                        [](double t, const Key& key) { return t < key.mTime; });
    const Key* second = after == keys + count ? after - 1 : after;
    const Key* first = after == keys ? after : after - 1;
    const double span = second->mTime - first->mTime;
    share =
        span > 0.0 ? static_cast<float>(std::clamp((time - first->mTime) / span, 0.0, 1.0)) : 0.0f;
    return {first, second};
  }

  static glm::vec3 SampleVector(const aiVectorKey* keys,
                                unsigned count,
                                double time,
                                const glm::vec3& fallback) {
    if (count == 0) {
      return fallback;
    }
    float share = 0.0f;
    const auto [first, second] = Neighbours(keys, count, time, share);
    return glm::mix(ToGlm(first->mValue), ToGlm(second->mValue), share);
  }

  static glm::quat SampleRotation(const aiQuatKey* keys, unsigned count, double time) {
    if (count == 0) {
      return {1.0f, 0.0f, 0.0f, 0.0f};
    }
    float share = 0.0f;
    const auto [first, second] = Neighbours(keys, count, time, share);
    return glm::slerp(ToGlm(first->mValue), ToGlm(second->mValue), share);
  }

  bool EndsWhereItBegins(const human::Clip& clip) const {
    const size_t joint_count = human_.skeleton.size();
    const size_t last = clip.keys.size() - joint_count;
    for (size_t joint = 0; joint < joint_count; ++joint) {
      const human::JointTransform& a = clip.keys[joint];
      const human::JointTransform& b = clip.keys[last + joint];
      if (!(std::abs(glm::dot(a.rotation, b.rotation)) > 1.0f - 1e-5f) ||
          !(glm::distance(a.translation, b.translation) < 1e-3f)) {
        return false;
      }
    }
    return last > 0;
  }

  const aiScene& scene_;
  std::string place_;
  ImportOptions options_;
  glm::quat turn_;
  glm::mat4 actor_from_scene_;
  std::vector<const aiNode*> nodes_;
  std::map<const aiNode*, size_t> joint_of_node_;
  std::map<std::string, size_t> joint_of_name_;
  size_t vertex_count_ = 0;
  size_t key_count_ = 0;
  human::Human human_;
};

}  // namespace

Result<human::Human> ImportHuman(const std::filesystem::path& file, const ImportOptions& options) {
  if (!(options.metres_per_unit > 0.0f) || !(options.keys_per_second > 0.0f) ||
      options.keys_per_second > 1000.0f) {
    return Status::Error(file.string(), "the import's scale and key rate must be above 0");
  }
  Assimp::Importer importer;
  LARARIUM_ASSIGN_OR_RETURN(const aiScene* scene, ReadScene(importer, file));
  ImportOptions named = options;
  if (named.name.empty()) {
    named.name = file.stem().string();
  }
  return HumanBuilder(*scene, file.string(), named).Build();
}

Result<geometry::TriangleMesh> ImportMesh(const std::filesystem::path& file) {
  Assimp::Importer importer;
  LARARIUM_ASSIGN_OR_RETURN(const aiScene* scene, ReadScene(importer, file));
  LARARIUM_ASSIGN_OR_RETURN(const std::vector<const aiNode*> nodes,
                            ListNodes(*scene, file.string()));
  geometry::TriangleMesh result;
  for (const aiNode* node : nodes) {
    const glm::mat4 scene_from_node = SceneFromNode(node);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      const aiMesh& mesh = *scene->mMeshes[node->mMeshes[i]];
      const auto first = static_cast<uint32_t>(result.positions.size());
      if (first + size_t{mesh.mNumVertices} > kMaxVertices) {
        return Status::Error(file.string(),
                             "there are more than " + std::to_string(kMaxVertices) + " vertices");
      }
      for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        result.positions.emplace_back(scene_from_node * glm::vec4(ToGlm(mesh.mVertices[v]), 1.0f));
      }
      AppendIndices(mesh, first, result.indices);
    }
  }
  if (result.indices.empty()) {
    return Status::Error(file.string(), "there is no triangle in it");
  }
  LARARIUM_RETURN_IF_ERROR(result.Validate(file.string()));
  geometry::ComputeNormals(result);
  return result;
}

}  // namespace lararium::import
