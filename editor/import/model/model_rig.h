#pragma once

// Extracts the bones of a scene as a rig and maps them to the joints of H-Anim.

#include <set>
#include <string>
#include <vector>

#include "editor/import/model/bone_map.h"
#include "editor/import/model/model_bind_pose.h"
#include "editor/import/model/model_scene.h"

namespace lararium::import {

// What to import from a file: everything, only skeleton and clips, or a thing.
// Objects are rigid parts, each of which may move; scenery is one rigid part.
enum class Content { kFigure, kMotion, kObject, kScenery };
inline bool IsRigid(Content content) {
  return content == Content::kObject || content == Content::kScenery;
}

struct ModelRig {
  Rig bones;                      // Bind pose, in the axes and units of the scene.
  std::vector<int> node_of_bone;  // Parallel to `bones`, ascending.
  BoneMap map;
  // Nodes that the file uses as bones: a skin refers to them, clips move them (for kMotion),
  // VRM names them as bones, or they swing. If it is empty, the model is a puppet of rigid
  // parts, and any of its nodes may move.
  std::set<int> bone_nodes;
  bool is_posed = false;  // The pose is one of a motion: the figure may face any way.
};

// The rig contains the bone nodes and all their ancestors, without the pivots of FBX. `saved`
// is the map that the user trusts; bones in it that do not exist are listed in `notes`. Errors,
// unless it is rigid: a scene that is neither bound to a skeleton nor built like a human body.
Result<ModelRig> FindRig(const ModelScene& model,
                         const BindPose& bind,
                         Content content,
                         const BoneNames& saved,
                         std::vector<std::string>& notes);

}  // namespace lararium::import
