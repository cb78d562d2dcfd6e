#pragma once

// The bones of a scene as a rig, and which joint of H-Anim each of them is.

#include <set>
#include <string>
#include <vector>

#include "editor/import/bone_map.h"
#include "editor/import/model_bind_pose.h"
#include "editor/import/model_scene.h"

namespace lararium::import {

// What is wanted of a file: everything, or skeleton and clips alone.
enum class Content { kFigure, kMotion };

struct ModelRig {
  Rig bones;                      // bind pose; axes and units of the scene
  std::vector<int> node_of_bone;  // parallel to bones, ascending
  BoneMap map;
  // Nodes that the file treats as bones: they hold skins, are moved by clips (for kMotion),
  // are a VRM's bones or swing. Empty: a puppet of rigid parts, any of which may move.
  std::set<int> bone_nodes;
};

// The rig holds the bone nodes and all their ancestors, without FBX's pivots. saved: the map
// that the user trusts; what it names in vain is added to the notes. Errors: a scene that
// is neither bound to a skeleton nor built like a human body.
Result<ModelRig> FindRig(const ModelScene& model,
                         const BindPose& bind,
                         Content content,
                         const BoneNames& saved,
                         std::vector<std::string>& notes);

}  // namespace lararium::import
