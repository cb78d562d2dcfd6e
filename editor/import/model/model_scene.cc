#include "editor/import/model/model_scene.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "editor/import/model/bvh_scene.h"
#include "editor/import/model/survey_offset.h"
#include "shared/core/file.h"
#include "shared/core/lower_case.h"
#include "shared/core/plain_text.h"
#include "shared/core/release.h"

namespace lararium::import {
namespace {

constexpr size_t kMaxNodes = 20'000;
constexpr char kPivot[] = "_$AssimpFbx$_";  // Marks the nodes that assimp adds for FBX.

// Reads only files below one folder.
class FolderFiles : public Assimp::DefaultIOSystem {
 public:
  explicit FolderFiles(const std::filesystem::path& folder)
      : folder_(std::filesystem::weakly_canonical(folder)) {}

  bool Exists(const char* path) const override {
    const std::string resolved = Resolve(path);
    return !resolved.empty() && DefaultIOSystem::Exists(resolved.c_str());
  }

  Assimp::IOStream* Open(const char* path, const char* mode) override {
    const std::string resolved = Resolve(path);
    const bool reads = mode != nullptr && std::strpbrk(mode, "wa+") == nullptr;
    return resolved.empty() || !reads ? nullptr : DefaultIOSystem::Open(resolved.c_str(), mode);
  }

 private:
  std::string Resolve(const char* path) const {
    std::error_code error;
    std::filesystem::path full(path);
    full = std::filesystem::weakly_canonical(full.is_absolute() ? full : folder_ / full, error);
    const auto [at, end] = std::mismatch(folder_.begin(), folder_.end(), full.begin(), full.end());
    return error || at != folder_.end() ? std::string() : full.string();
  }

  std::filesystem::path folder_;
};

void Configure(ModelScene& model) {
  Assimp::Importer& importer = model.importer;
  importer.SetIOHandler(new FolderFiles(std::filesystem::absolute(model.file).parent_path()));
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
}

Status ReadGltf(std::span<const std::byte> bytes, ModelScene& model) {
  LARARIUM_ASSIGN_OR_RETURN(model.gltf, ParseGltf(bytes, model.place()));
  LARARIUM_RETURN_IF_ERROR(ReadGltfBuffers(model.file, *model.gltf));
  model.extension = model.gltf->is_binary ? ".glb" : ".gltf";
  LARARIUM_ASSIGN_OR_RETURN(model.own_scene,
                            ReadGltfScene(*model.gltf, model.place(), model.notes));
  model.gltf->buffers.clear();
  model.vrm = ReadVrm(*model.gltf);
  model.scene = model.own_scene.get();
  return Status();
}

Status CannotBeImported(const std::filesystem::path& file, const std::string& why) {
  return Status::Error(file.string(), "cannot be imported: " + why,
                       "export it again, best as glTF 2.0 binary (.glb)");
}

// Reads the file, or `bytes` if it is not empty.
Status ReadWithAssimp(std::span<const std::byte> bytes, ModelScene& model) {
  constexpr unsigned kSteps = aiProcess_ValidateDataStructure | aiProcess_Triangulate |
                              aiProcess_SortByPType | aiProcess_GenSmoothNormals;
  try {
    Configure(model);
    model.scene =
        bytes.empty()
            ? model.importer.ReadFile(std::filesystem::absolute(model.file).string(), kSteps)
            : model.importer.ReadFileFromMemory(bytes.data(), bytes.size(), kSteps,
                                                model.extension.c_str() + 1);
  } catch (const std::exception& exception) {
    return CannotBeImported(model.file, exception.what());
  } catch (...) {
    return CannotBeImported(model.file, "its reader gave up");
  }
  if (model.scene != nullptr) {
    return Status();
  }
  const std::string_view why = model.importer.GetErrorString();
  for (const std::string_view bare : {"contains no faces", "No meshes remaining"}) {
    if (why.find(bare) != why.npos) {
      return Status::Error(model.place(), "holds points or lines, but no faces",
                           "make a mesh of its points first, as photogrammetry programs and "
                           "CloudCompare do");
    }
  }
  return CannotBeImported(model.file, std::string(why));
}

// The keys on either side of a time; `share` gets the weight of the second.
template <typename Key>
std::pair<const Key*, const Key*> Neighbours(const Key* keys,
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

glm::vec3 SampleVector(const aiVectorKey* keys, unsigned count, double time) {
  float share = 0.0f;
  const auto [first, second] = Neighbours(keys, count, time, share);
  return glm::mix(ToGlm(first->mValue), ToGlm(second->mValue), share);
}

glm::quat SampleRotation(const aiQuatKey* keys, unsigned count, double time) {
  float share = 0.0f;
  const auto [first, second] = Neighbours(keys, count, time, share);
  return glm::slerp(ToGlm(first->mValue), ToGlm(second->mValue), share);
}

glm::mat4 SampleChannel(const aiNodeAnim& channel, const aiNode& node, double ticks) {
  aiVector3D scale, position;
  aiQuaternion rotation;
  node.mTransformation.Decompose(scale, rotation, position);
  const glm::vec3 t = channel.mNumPositionKeys == 0
                          ? ToGlm(position)
                          : SampleVector(channel.mPositionKeys, channel.mNumPositionKeys, ticks);
  const glm::quat r = channel.mNumRotationKeys == 0
                          ? ToGlm(rotation)
                          : SampleRotation(channel.mRotationKeys, channel.mNumRotationKeys, ticks);
  const glm::vec3 s = channel.mNumScalingKeys == 0
                          ? ToGlm(scale)
                          : SampleVector(channel.mScalingKeys, channel.mNumScalingKeys, ticks);
  return glm::translate(glm::mat4(1.0f), t) * glm::mat4_cast(glm::normalize(r)) *
         glm::scale(glm::mat4(1.0f), s);
}

template <typename Key>
void Extend(const Key* keys, unsigned count, double& first, double& last) {
  if (count > 0) {
    first = std::min(first, keys[0].mTime);
    last = std::max(last, keys[count - 1].mTime);
  }
}

Result<SceneNodes> ListNodes(const ModelScene& model) {
  SceneNodes list;
  list.nodes = {model.scene->mRootNode};
  list.parents = {SceneNodes::kNoParent};
  for (size_t i = 0; i < list.nodes.size(); ++i) {
    const aiNode& node = *list.nodes[i];
    if (list.nodes.size() + node.mNumChildren > kMaxNodes) {
      return Status::Error(model.place(),
                           "there are more than " + std::to_string(kMaxNodes) + " nodes");
    }
    list.nodes.insert(list.nodes.end(), node.mChildren, node.mChildren + node.mNumChildren);
    list.parents.insert(list.parents.end(), node.mNumChildren, static_cast<int>(i));
    list.local.push_back(ToGlm(node.mTransformation));
    std::string name = node.mName.C_Str();
    const bool indexed = model.gltf.has_value() && name.size() > 1 && name.size() < 8 &&
                         name[0] == 'n' &&
                         name.find_first_not_of("0123456789", 1) == std::string::npos;
    list.names.push_back(indexed ? model.gltf->NodeName(std::stoul(name.substr(1))) : name);
  }
  return list;
}

}  // namespace

glm::mat4 ToGlm(const aiMatrix4x4& m) {
  return glm::transpose(glm::mat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4,  //
                                  m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4));
}

float ModelScene::StatedMetresPerUnit() const {
  double centimetres = 0.0;
  if (extension == ".fbx" && scene->mMetaData != nullptr) {
    float single = 0.0f;
    if (!scene->mMetaData->Get("UnitScaleFactor", centimetres) &&
        scene->mMetaData->Get("UnitScaleFactor", single)) {
      centimetres = single;
    }
  }
  return centimetres > 0.0 && centimetres < 1e6 ? static_cast<float>(0.01 * centimetres) : 1.0f;
}

Result<std::unique_ptr<ModelScene>> ReadModelScene(const std::filesystem::path& file,
                                                   glm::dvec3* survey_offset) {
  auto model = std::make_unique<ModelScene>();
  model->file = file;
  model->extension = LowerCase(file.extension().string());
  LARARIUM_ASSIGN_OR_RETURN(std::vector<std::byte> bytes, ReadBytes(file));
  if (bytes.empty()) {
    return Status::Error(file.string(), "the file is empty");
  }
  const std::string_view file_text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const size_t mark = file_text.size() - WithoutByteOrderMark(file_text).size();
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(mark));
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (LooksLikeGltf(bytes)) {
    LARARIUM_RETURN_IF_ERROR(ReadGltf(bytes, *model));
  } else if (model->extension == ".bvh" || LooksLikeBvh(text)) {
    LARARIUM_ASSIGN_OR_RETURN(model->own_scene,
                              ReadBvhScene(text, model->place(), model->notes.structure));
    model->scene = model->own_scene.get();
  } else {
    const glm::dvec3 offset =
        survey_offset == nullptr ? glm::dvec3(0.0) : TakeOffSurvey(model->extension, bytes);
    if (offset != glm::dvec3(0.0)) {
      *survey_offset = offset;
    } else if (mark == 0) {
      Release(bytes);
    }
    LARARIUM_RETURN_IF_ERROR(ReadWithAssimp(bytes, *model));
  }
  if (model->scene->mRootNode == nullptr) {
    return CannotBeImported(file, "there is nothing in it");
  }
  LARARIUM_ASSIGN_OR_RETURN(model->nodes, ListNodes(*model));
  return model;
}

int SceneNodes::Find(const aiString& name) const {
  const auto found = std::find_if(nodes.begin(), nodes.end(),
                                  [&](const aiNode* node) { return node->mName == name; });
  return found == nodes.end() ? kNoParent : static_cast<int>(found - nodes.begin());
}

int SceneNodes::FindGltf(size_t gltf_node) const {
  return Find(aiString("n" + std::to_string(gltf_node)));
}

bool SceneNodes::IsPivot(size_t node) const {
  return std::strstr(nodes[node]->mName.C_Str(), kPivot) != nullptr;
}

void SceneNodes::Globals(std::span<const glm::mat4> from_local,
                         std::span<glm::mat4> scene_from_node) const {
  for (size_t i = 0; i < size(); ++i) {
    scene_from_node[i] = parents[i] == kNoParent
                             ? from_local[i]
                             : scene_from_node[static_cast<size_t>(parents[i])] * from_local[i];
  }
}

AnimationSampler::AnimationSampler(const aiAnimation& animation, const SceneNodes& nodes) {
  ticks_per_second_ = animation.mTicksPerSecond > 0.0 ? animation.mTicksPerSecond : 25.0;
  double first = std::numeric_limits<double>::max(), last = 0.0;
  for (unsigned c = 0; c < animation.mNumChannels; ++c) {
    const aiNodeAnim& keys = *animation.mChannels[c];
    const int node = nodes.Find(keys.mNodeName);
    if (node != SceneNodes::kNoParent) {
      channels_.push_back({&keys, nodes.nodes[static_cast<size_t>(node)], node});
      ReplacePivots(nodes, node);
      Extend(keys.mPositionKeys, keys.mNumPositionKeys, first, last);
      Extend(keys.mRotationKeys, keys.mNumRotationKeys, first, last);
      Extend(keys.mScalingKeys, keys.mNumScalingKeys, first, last);
    }
  }
  if (last > first) {
    first_tick_ = first;
    duration_ = (last - first) / ticks_per_second_;
  }
}

// Assimp 5.2 puts translation and pre-rotation of an FBX node into pivots above it, but keeps
// them in the channel of the node too.
void AnimationSampler::ReplacePivots(const SceneNodes& nodes, int node) {
  const std::string pivot =
      std::string(nodes.nodes[static_cast<size_t>(node)]->mName.C_Str()) + kPivot;
  for (int above = nodes.parents[static_cast<size_t>(node)];
       above != SceneNodes::kNoParent &&
       std::string_view(nodes.nodes[static_cast<size_t>(above)]->mName.C_Str()).starts_with(pivot);
       above = nodes.parents[static_cast<size_t>(above)]) {
    replaced_pivots_.push_back(static_cast<size_t>(above));
  }
}

void AnimationSampler::Sample(double seconds, std::span<glm::mat4> local) const {
  for (const size_t pivot : replaced_pivots_) {
    local[pivot] = glm::mat4(1.0f);
  }
  const double ticks = first_tick_ + seconds * ticks_per_second_;
  for (const Channel& channel : channels_) {
    local[static_cast<size_t>(channel.node)] = SampleChannel(*channel.keys, *channel.rest, ticks);
  }
}

}  // namespace lararium::import
