#pragma once

// A model file as assimp reads it, with what our code has to know besides. Internal to
// editor/import: only what runs in model_isolation's child reads foreign files with it.

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "editor/import/model_gltf.h"
#include "editor/import/vrm.h"
#include "shared/core/status.h"

namespace lararium::import {

inline glm::vec3 ToGlm(const aiVector3D& v) { return {v.x, v.y, v.z}; }
inline glm::quat ToGlm(const aiQuaternion& q) { return {q.w, q.x, q.y, q.z}; }
glm::mat4 ToGlm(const aiMatrix4x4& m);

// The nodes of a scene, parents before children; parallel arrays.
struct SceneNodes {
  static constexpr int kNoParent = -1;

  std::vector<const aiNode*> nodes;
  std::vector<int> parents;
  std::vector<glm::mat4> local;    // parent_from_node
  std::vector<std::string> names;  // as in the file

  size_t size() const { return nodes.size(); }
  // The node that assimp calls so; kNoParent: none.
  int Find(const aiString& name) const;
  int FindGltf(size_t gltf_node) const;
  // FBX's pivots, which assimp turns into nodes of their own.
  bool IsPivot(size_t node) const;
  void Globals(std::span<const glm::mat4> local, std::span<glm::mat4> scene_from_node) const;
};

struct ModelScene {
  Assimp::Importer importer;  // owns the scene
  const aiScene* scene = nullptr;
  SceneNodes nodes;
  std::optional<GltfDocument> gltf;
  std::optional<Vrm> vrm;  // only where it is a glTF
  std::filesystem::path file;
  std::string extension;  // small letters, with its dot

  // What errors name.
  std::string place() const { return file.string(); }
  bool HasUnits() const { return gltf.has_value() || extension == ".fbx"; }
  // Metres per unit as the format or the file says it; 1 where they say nothing.
  float StatedMetresPerUnit() const;
};

// Opens nothing outside the folder of the file. Errors name the file.
Result<std::unique_ptr<ModelScene>> ReadModelScene(const std::filesystem::path& file);

// One animation, sampled at any time.
class AnimationSampler {
 public:
  AnimationSampler(const aiAnimation& animation, const SceneNodes& nodes);

  double duration() const { return duration_; }  // seconds
  // local as at a time in seconds from the beginning; nodes that it does not move keep theirs.
  void Sample(double seconds, std::span<glm::mat4> local) const;

 private:
  struct Channel {
    const aiNodeAnim* keys;
    const aiNode* rest;
    int node;
  };
  std::vector<Channel> channels_;
  double ticks_per_second_ = 25.0;
  double first_tick_ = 0.0;
  double duration_ = 0.0;
};

}  // namespace lararium::import
