#include "editor/import/cast/cast_rig.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <string>
#include <utility>

namespace lararium::import {
namespace {

// A joint, and the bone that gives its weights and whose head gives its position. % stands for
// the side.
struct JointSource {
  const char* name;
  const char* parent;
  const char* bone;
};

constexpr JointSource kMiddle[] = {
    {"humanoid_root", "", "root"},
    {"sacroiliac", "humanoid_root", "pelvis.L"},
    {"vl5", "humanoid_root", "spine05"},
    {"vl1", "vl5", "spine04"},
    {"vt10", "vl1", "spine03"},
    {"vt4", "vt10", "spine02"},
    {"vt1", "vt4", "spine01"},
    {"vc7", "vt1", "neck01"},
    {"vc4", "vc7", "neck02"},
    {"vc2", "vc4", "neck03"},
    {"skullbase", "vc2", "head"},
    {"temporomandibular", "skullbase", "jaw"},
    {"tongue_base", "temporomandibular", "tongue01"},
    {"tongue_tip", "tongue_base", "tongue03"},
};

constexpr JointSource kSides[] = {
    {"eyeball_joint", "skullbase", "eye"},
    {"sternoclavicular", "vt1", "clavicle"},
    {"acromioclavicular", "%sternoclavicular", "shoulder01"},
    {"shoulder", "%acromioclavicular", "upperarm01"},
    {"elbow", "%shoulder", "lowerarm01"},
    {"wrist", "%elbow", "wrist"},
    {"thumb1", "%wrist", "finger1-1"},
    {"thumb2", "%thumb1", "finger1-2"},
    {"thumb3", "%thumb2", "finger1-3"},
    {"index0", "%wrist", "metacarpal1"},
    {"index1", "%index0", "finger2-1"},
    {"index2", "%index1", "finger2-2"},
    {"index3", "%index2", "finger2-3"},
    {"middle0", "%wrist", "metacarpal2"},
    {"middle1", "%middle0", "finger3-1"},
    {"middle2", "%middle1", "finger3-2"},
    {"middle3", "%middle2", "finger3-3"},
    {"ring0", "%wrist", "metacarpal3"},
    {"ring1", "%ring0", "finger4-1"},
    {"ring2", "%ring1", "finger4-2"},
    {"ring3", "%ring2", "finger4-3"},
    {"pinky0", "%wrist", "metacarpal4"},
    {"pinky1", "%pinky0", "finger5-1"},
    {"pinky2", "%pinky1", "finger5-2"},
    {"pinky3", "%pinky2", "finger5-3"},
    {"hip", "sacroiliac", "upperleg01"},
    {"knee", "%hip", "lowerleg01"},
    {"ankle", "%knee", "foot"},
    {"midtarsal", "%ankle", "toe3-1"},
};

// Bones whose weights do not go to their nearest ancestor that is a joint. Corners of the mouth
// and cheeks follow half of the rotation of the jaw.
struct Split {
  const char* bone;
  const char* joint;
  float share;
};
constexpr Split kSplits[] = {
    {"pelvis.R", "sacroiliac", 1.0f},
    {"toe1-1.L", "l_midtarsal", 1.0f},
    {"toe2-1.L", "l_midtarsal", 1.0f},
    {"toe4-1.L", "l_midtarsal", 1.0f},
    {"toe5-1.L", "l_midtarsal", 1.0f},
    {"toe1-1.R", "r_midtarsal", 1.0f},
    {"toe2-1.R", "r_midtarsal", 1.0f},
    {"toe4-1.R", "r_midtarsal", 1.0f},
    {"toe5-1.R", "r_midtarsal", 1.0f},
    {"levator05.L", "temporomandibular", 0.5f},
    {"levator05.R", "temporomandibular", 0.5f},
    {"risorius03.L", "temporomandibular", 0.5f},
    {"risorius03.R", "temporomandibular", 0.5f},
};

struct NamedJoint {
  std::string name;
  std::string parent;
  std::string bone;
};

std::vector<NamedJoint> AllJoints() {
  std::vector<NamedJoint> joints;
  for (const JointSource& source : kMiddle) {
    joints.push_back({source.name, source.parent, source.bone});
  }
  for (const auto& [prefix, suffix] : {std::pair("l_", ".L"), std::pair("r_", ".R")}) {
    for (const JointSource& source : kSides) {
      std::string parent = source.parent;
      if (parent.starts_with("%")) {
        parent = prefix + parent.substr(1);
      }
      joints.push_back(
          {std::string(prefix) + source.name, parent, std::string(source.bone) + suffix});
    }
  }
  return joints;
}

const CastBone* FindBone(const CastLibrary& library, const std::string& name) {
  const std::vector<CastBone>& bones = library.base().bones;
  const auto found = std::find_if(bones.begin(), bones.end(),
                                  [&name](const CastBone& bone) { return bone.name == name; });
  return found == bones.end() ? nullptr : &*found;
}

glm::vec3 Mean(std::span<const uint32_t> vertices, std::span<const glm::vec3> positions) {
  glm::vec3 sum(0.0f);
  for (const uint32_t v : vertices) {
    sum += positions[v];
  }
  return sum / static_cast<float>(vertices.size());
}

// The mean of the heads of the named bones.
Result<glm::vec3> MeanHead(const CastLibrary& library,
                           std::span<const glm::vec3> positions,
                           std::span<const std::string> bones) {
  glm::vec3 sum(0.0f);
  for (const std::string& name : bones) {
    const CastBone* bone = FindBone(library, name);
    if (bone == nullptr) {
      return Status::Error(library.folder().string(), "its rig has no bone '" + name + "'",
                           "fetch the cast library again");
    }
    sum += Mean(bone->head_vertices, positions);
  }
  return sum / static_cast<float>(bones.size());
}

// The position of a joint is the head of its bone, with these exceptions.
std::vector<std::string> PlaceBones(const NamedJoint& joint) {
  if (joint.name == "humanoid_root" || joint.name == "sacroiliac") {
    return {"spine05"};  // The root bone is behind the body.
  }
  if (joint.name.ends_with("midtarsal")) {
    const std::string side = joint.bone.substr(joint.bone.size() - 2);
    return {"toe1-1" + side, "toe2-1" + side, "toe3-1" + side, "toe4-1" + side, "toe5-1" + side};
  }
  return {joint.bone};
}

using Shares = std::vector<std::pair<uint8_t, float>>;  // (joint, share).

// The joints that take the weight of each bone.
std::vector<Shares> SharesOfBones(const CastLibrary& library, const human::Skeleton& skeleton) {
  std::map<std::string, uint8_t> joint_of_bone;
  for (const NamedJoint& joint : AllJoints()) {
    joint_of_bone[joint.bone] = static_cast<uint8_t>(*skeleton.Find(joint.name));
  }
  std::map<std::string, std::pair<uint8_t, float>> splits;
  for (const Split& split : kSplits) {
    splits[split.bone] = {static_cast<uint8_t>(*skeleton.Find(split.joint)), split.share};
  }
  const std::vector<CastBone>& bones = library.base().bones;
  std::vector<Shares> shares(bones.size());
  for (size_t i = 0; i < bones.size(); ++i) {
    const auto own = joint_of_bone.find(bones[i].name);
    if (own != joint_of_bone.end()) {
      shares[i] = {{own->second, 1.0f}};
    } else if (bones[i].parent >= 0) {
      shares[i] = shares[bones[i].parent];
    } else {
      shares[i] = {{0, 1.0f}};
    }
    if (const auto split = splits.find(bones[i].name); split != splits.end()) {
      const auto [joint, share] = split->second;
      for (auto& [unused, weight] : shares[i]) {
        weight *= 1.0f - share;
      }
      shares[i].emplace_back(joint, share);
    }
  }
  return shares;
}

}  // namespace

Result<human::Skeleton> CastSkeleton(const CastLibrary& library,
                                     std::span<const glm::vec3> positions) {
  human::Skeleton skeleton;
  std::vector<glm::vec3> places;
  for (const NamedJoint& joint : AllJoints()) {
    LARARIUM_ASSIGN_OR_RETURN(const glm::vec3 place,
                              MeanHead(library, positions, PlaceBones(joint)));
    human::JointTransform rest;
    rest.translation = place;
    int16_t parent = human::Skeleton::kNoParent;
    if (!joint.parent.empty()) {
      parent = static_cast<int16_t>(*skeleton.Find(joint.parent));
      rest.translation -= places[parent];
    }
    skeleton.names.push_back(joint.name);
    skeleton.parents.push_back(parent);
    skeleton.rest.push_back(rest);
    skeleton.joint_from_actor.push_back(glm::translate(glm::mat4(1.0f), -place));
    places.push_back(place);
  }
  return skeleton;
}

CastWeights WeightsOf(const CastLibrary& library, const human::Skeleton& skeleton) {
  const std::vector<Shares> shares = SharesOfBones(library, skeleton);
  const CastBase& base = library.base();
  CastWeights result;
  for (size_t v = 0; v < base.mesh.positions.size(); ++v) {
    Shares influences;
    for (int k = 0; k < 4; ++k) {
      for (const auto& [joint, share] : shares[base.vertex_bones[v][k]]) {
        influences.emplace_back(joint, share * base.vertex_weights[v][k]);
      }
    }
    const Influences strongest = Strongest(influences);
    result.joints.push_back(strongest.joints);
    result.weights.push_back(strongest.weights);
  }
  return result;
}

Influences Strongest(std::span<const std::pair<uint8_t, float>> influences) {
  Shares merged;
  for (const auto& [joint, weight] : influences) {
    const auto same = std::find_if(merged.begin(), merged.end(),
                                   [joint = joint](const auto& m) { return m.first == joint; });
    if (same != merged.end()) {
      same->second += weight;
    } else if (weight > 0.0f) {
      merged.emplace_back(joint, weight);
    }
  }
  std::stable_sort(merged.begin(), merged.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  merged.resize(std::min<size_t>(merged.size(), 4));
  float sum = 0.0f;
  for (const auto& [unused, weight] : merged) {
    sum += weight;
  }
  Influences strongest;
  for (size_t k = 0; k < merged.size() && sum > 0.0f; ++k) {
    strongest.joints[k] = merged[k].first;
    strongest.weights[static_cast<int>(k)] = merged[k].second / sum;
  }
  return strongest;
}

}  // namespace lararium::import
