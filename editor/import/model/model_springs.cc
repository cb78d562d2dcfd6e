#include "editor/import/model/model_springs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "editor/import/model/model_matrix.h"

namespace lararium::import {
namespace {

constexpr float kRate = 60.0f;      // Frames per second of VRM's reference implementation.
constexpr float kShortest = 0.01f;  // Shortest bone that swings, metres.
constexpr float kGravity = 9.81f;   // m/s^2

std::vector<uint32_t> ChainOf(const Vrm::Spring& spring,
                              const SceneNodes& nodes,
                              const ModelSkeleton& skeleton) {
  std::vector<uint32_t> chain;
  for (const size_t gltf_node : spring.nodes) {
    const int node = nodes.FindGltf(gltf_node);
    if (node == SceneNodes::kNoParent) {
      break;
    }
    const uint32_t joint = skeleton.joint_of_node[static_cast<size_t>(node)];
    const bool is_joint = skeleton.node_of_joint[joint] == static_cast<size_t>(node);
    const bool follows =
        chain.empty() || skeleton.joints.parents[joint] == static_cast<int>(chain.back());
    if (!is_joint || !follows) {
      break;
    }
    chain.push_back(joint);
  }
  return chain;
}

// In each 1/60 s a VRM spring moves by stiffness/60 towards the pose and keeps 1 - drag of its
// velocity. For a bone of length l this is an acceleration of 60 stiffness / l per radian with
// a drag of -60 ln(1 - drag).
human::SpringChain BuildSpring(const Vrm::Spring& spring,
                               std::vector<uint32_t> joints,
                               const human::Skeleton& skeleton) {
  float length = 0.0f;
  for (size_t i = 1; i < joints.size(); ++i) {
    length += glm::length(skeleton.rest[joints[i]].translation);
  }
  length = std::max(length / static_cast<float>(joints.size() - 1), kShortest);
  human::SpringChain chain;
  chain.name = spring.name.empty() ? "spring" : spring.name;
  chain.joints = std::move(joints);
  chain.stiffness = kRate * spring.stiffness / length;
  chain.drag = -kRate * std::log(1.0f - spring.drag);
  chain.gravity = kRate * spring.gravity / kGravity;
  chain.radius = spring.radius;
  return chain;
}

}  // namespace

std::vector<human::SpringChain> BuildSprings(const ModelScene& model,
                                             const ModelSkeleton& skeleton) {
  std::vector<human::SpringChain> springs;
  if (!model.vrm) {
    return springs;
  }
  for (const Vrm::Spring& spring : model.vrm->springs) {
    std::vector<uint32_t> joints = ChainOf(spring, model.nodes, skeleton);
    if (joints.size() >= 2) {
      springs.push_back(BuildSpring(spring, std::move(joints), skeleton.joints));
    }
  }
  return springs;
}

std::vector<human::BodyCapsule> BuildCapsules(const ModelScene& model,
                                              const BindPose& bind,
                                              const ModelSkeleton& skeleton) {
  std::vector<human::BodyCapsule> capsules;
  if (!model.vrm) {
    return capsules;
  }
  for (const Vrm::Collider& collider : model.vrm->colliders) {
    const int node = model.nodes.FindGltf(collider.node);
    if (node == SceneNodes::kNoParent) {
      continue;
    }
    const auto n = static_cast<size_t>(node);
    const glm::mat4 actor_from_node = skeleton.actor_from_scene * bind.scene_from_node[n];
    human::BodyCapsule capsule;
    capsule.joint = skeleton.joint_of_node[n];
    capsule.a = Apply(actor_from_node, collider.a) - skeleton.positions[capsule.joint];
    capsule.b = Apply(actor_from_node, collider.b) - skeleton.positions[capsule.joint];
    capsule.radius_a = capsule.radius_b = collider.radius * ScaleOf(actor_from_node);
    if (capsule.Validate(skeleton.joints.size(), model.place()).ok()) {
      capsules.push_back(capsule);
    }
  }
  return capsules;
}

}  // namespace lararium::import
