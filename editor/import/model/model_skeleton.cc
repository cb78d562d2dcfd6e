#include "editor/import/model/model_skeleton.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <set>
#include <string>

#include "editor/import/model/model_matrix.h"

namespace lararium::import {
namespace {

using human::Skeleton;

// Nodes that move vertices or swing; in a motion, all bone nodes.
std::set<int> MovingNodes(const ModelScene& model,
                          std::span<const Part> parts,
                          const ModelRig& rig) {
  if (parts.empty()) {
    return rig.bone_nodes;
  }
  std::set<int> nodes;
  for (const Part& part : parts) {
    for (const Influences& influences : part.influences) {
      for (const Influence& influence : influences) {
        nodes.insert(influence.weight > 0.0f ? influence.node : SceneNodes::kNoParent);
      }
    }
  }
  if (model.vrm) {
    for (const Vrm::Spring& spring : model.vrm->springs) {
      for (const size_t node : spring.nodes) {
        nodes.insert(model.nodes.FindGltf(node));
      }
    }
  }
  return nodes;
}

std::vector<bool> NeededBones(const std::set<int>& moving, const ModelRig& rig) {
  std::vector<bool> needed(rig.bones.size(), false);
  for (size_t bone = 0; bone < needed.size(); ++bone) {
    const int node = rig.node_of_bone[bone];
    needed[bone] =
        moving.contains(node) && (rig.bone_nodes.contains(node) || rig.bone_nodes.empty());
  }
  for (const MappedBone& mapped : rig.map.bones) {
    needed[mapped.bone] = true;
  }
  return needed;
}

class SkeletonBuilder {
 public:
  SkeletonBuilder(const ModelScene& model,
                  const BindPose& bind,
                  const ModelRig& rig,
                  const glm::mat4& actor_from_scene)
      : model_(model), bind_(bind), rig_(rig) {
    built_.actor_from_scene = actor_from_scene;
  }

  Result<ModelSkeleton> Build(const std::vector<bool>& needed) {
    LARARIUM_RETURN_IF_ERROR(AddJoints(needed));
    MapNodes();
    return std::move(built_);
  }

 private:
  // All bones between a needed bone and a needed ancestor are needed too.
  Status AddJoints(const std::vector<bool>& needed) {
    const Rig& bones = rig_.bones;
    std::vector<bool> has_needed_below = needed;
    for (size_t bone = bones.size(); bone-- > 0;) {
      if (has_needed_below[bone] && bones.parents[bone] != Rig::kNoParent) {
        has_needed_below[static_cast<size_t>(bones.parents[bone])] = true;
      }
    }
    joint_of_bone_.assign(bones.size(), Skeleton::kNoParent);
    size_t count = 0;
    for (size_t bone = 0; bone < bones.size(); ++bone) {
      const int above = bones.parents[bone] == Rig::kNoParent
                            ? int{Skeleton::kNoParent}
                            : joint_of_bone_[static_cast<size_t>(bones.parents[bone])];
      joint_of_bone_[bone] = above;
      if (needed[bone] || (above != Skeleton::kNoParent && has_needed_below[bone])) {
        if (++count <= Skeleton::kMaxJoints) {
          joint_of_bone_[bone] = AddJoint(bone, above);
        }
      }
    }
    if (count == 0) {
      return Status::Error(model_.place(), "no bone of it moves anything",
                           "export it with its armature");
    }
    if (count > Skeleton::kMaxJoints) {
      return Status::Error(
          model_.place(),
          "its skeleton needs " + std::to_string(count) + " joints, more than " +
              std::to_string(Skeleton::kMaxJoints),
          "remove bones of hair, clothes or face before exporting, or add it as an "
          "object");
    }
    return Status();
  }

  int AddJoint(size_t bone, int parent) {
    const auto node = static_cast<size_t>(rig_.node_of_bone[bone]);
    const glm::vec3 position =
        Apply(built_.actor_from_scene, glm::vec3(bind_.scene_from_node[node][3]));
    human::JointTransform rest;
    rest.translation = parent == Skeleton::kNoParent
                           ? position
                           : position - built_.positions[static_cast<size_t>(parent)];
    Skeleton& joints = built_.joints;
    joints.names.push_back(NameOf(bone));
    joints.parents.push_back(static_cast<int16_t>(parent));
    joints.rest.push_back(rest);
    joints.joint_from_actor.push_back(glm::translate(glm::mat4(1.0f), -position));
    built_.positions.push_back(position);
    built_.node_of_joint.push_back(node);
    return static_cast<int>(joints.size()) - 1;
  }

  // A bone must not have the name of a joint to which another bone is mapped.
  std::string NameOf(size_t bone) const {
    std::string name = rig_.bones.names[bone].substr(0, 256);
    for (const MappedBone& mapped : rig_.map.bones) {
      name = mapped.bone == bone ? mapped.joint : name;
    }
    const MappedBone* mapped = rig_.map.Find(name);
    const bool is_anothers = mapped != nullptr && mapped->bone != bone;
    if (name.empty() || is_anothers || built_.joints.Find(name)) {
      name += "#" + std::to_string(built_.joints.size());
    }
    return name;
  }

  void MapNodes() {
    const SceneNodes& nodes = model_.nodes;
    built_.joint_of_node.assign(nodes.size(), 0);
    std::vector<bool> is_bone(nodes.size(), false);
    for (size_t bone = 0; bone < rig_.bones.size(); ++bone) {
      const auto node = static_cast<size_t>(rig_.node_of_bone[bone]);
      built_.joint_of_node[node] = static_cast<uint32_t>(std::max(joint_of_bone_[bone], 0));
      is_bone[node] = true;
    }
    for (size_t n = 0; n < nodes.size(); ++n) {
      if (!is_bone[n] && nodes.parents[n] != SceneNodes::kNoParent) {
        built_.joint_of_node[n] = built_.joint_of_node[static_cast<size_t>(nodes.parents[n])];
      }
    }
  }

  const ModelScene& model_;
  const BindPose& bind_;
  const ModelRig& rig_;
  // Joint of each bone, or of its nearest ancestor that is a joint.
  std::vector<int> joint_of_bone_;
  ModelSkeleton built_;
};

}  // namespace

Result<ModelSkeleton> BuildSkeleton(const ModelScene& model,
                                    const BindPose& bind,
                                    std::span<const Part> parts,
                                    const ModelRig& rig,
                                    Content content,
                                    const glm::mat4& actor_from_scene) {
  std::vector<bool> needed(rig.bones.size(), false);
  if (content == Content::kScenery && !needed.empty()) {
    needed[0] = true;  // The root of the scene is the ancestor of all bones.
  } else {
    needed = NeededBones(MovingNodes(model, parts, rig), rig);
  }
  return SkeletonBuilder(model, bind, rig, actor_from_scene).Build(needed);
}

}  // namespace lararium::import
