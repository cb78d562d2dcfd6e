#pragma once

// A model file as a scene of assimp, with additional information that our code needs. glTF and
// BVH have readers of our own, assimp reads the other formats. Internal to editor/import: only
// code in the child process of model_isolation reads foreign files with it.

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

#include "editor/import/model/gltf_scene.h"
#include "editor/import/model/vrm.h"
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
  std::vector<std::string> names;  // Names in the file.

  size_t size() const { return nodes.size(); }
  // The node with the name that assimp uses; kNoParent if there is none.
  int Find(const aiString& name) const;
  int FindGltf(size_t gltf_node) const;
  // Says whether assimp made the node from a pivot of FBX.
  bool IsPivot(size_t node) const;
  void Globals(std::span<const glm::mat4> local, std::span<glm::mat4> scene_from_node) const;
};

struct ModelScene {
  Assimp::Importer importer;           // Owns the scene if assimp has read it.
  std::unique_ptr<aiScene> own_scene;  // The scene if a reader of ours has.
  const aiScene* scene = nullptr;
  SceneNodes nodes;
  std::optional<GltfDocument> gltf;
  std::optional<Vrm> vrm;  // Only in glTF files.
  std::filesystem::path file;
  std::string extension;  // Lower case, with its dot.
  GltfNotes notes;        // The reader lists here what it guessed or left out.

  // The name of the file, for errors.
  std::string place() const { return file.string(); }
  bool HasUnits() const { return gltf.has_value() || extension == ".fbx"; }
  // Metres per unit according to the format or the file; 1 if they do not state it.
  float StatedMetresPerUnit() const;
};

// Opens no files outside the folder of the file. If `survey_offset` is given, it gets what was
// taken off the positions of a mesh in survey coordinates (TakeOffSurvey). Errors name the file.
Result<std::unique_ptr<ModelScene>> ReadModelScene(const std::filesystem::path& file,
                                                   glm::dvec3* survey_offset = nullptr);

// One animation, sampled at any time.
class AnimationSampler {
 public:
  AnimationSampler(const aiAnimation& animation, const SceneNodes& nodes);

  double duration() const { return duration_; }  // seconds
  // Sets `local` to the state at a time in seconds from the beginning. Nodes without keys keep
  // theirs.
  void Sample(double seconds, std::span<glm::mat4> local) const;

 private:
  struct Channel {
    const aiNodeAnim* keys;
    const aiNode* rest;
    int node;
  };
  void ReplacePivots(const SceneNodes& nodes, int node);

  std::vector<Channel> channels_;
  std::vector<size_t> replaced_pivots_;  // Nodes whose part a channel contains too.
  double ticks_per_second_ = 25.0;
  double first_tick_ = 0.0;
  double duration_ = 0.0;
};

}  // namespace lararium::import
