#include "editor/import/cast/plain_skeleton.h"

#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "shared/core/check.h"

namespace lararium::import {
namespace {

struct Joint {
  const char* name;
  const char* parent;
  glm::vec3 position;  // Rest position, actor frame.
};

constexpr Joint kMiddle[] = {
    {"humanoid_root", "", {0.0f, 0.930f, 0.0f}},
    {"sacroiliac", "humanoid_root", {0.0f, 0.960f, 0.015f}},
    {"vl5", "humanoid_root", {0.0f, 1.010f, 0.025f}},
    {"vt10", "vl5", {0.0f, 1.165f, 0.030f}},
    {"vt4", "vt10", {0.0f, 1.320f, 0.040f}},
    {"vc4", "vt4", {0.0f, 1.440f, 0.035f}},
    {"skullbase", "vc4", {0.0f, 1.535f, 0.015f}},
};

// Joints of the right side; the left side mirrors them.
constexpr Joint kRight[] = {
    {"r_hip", "sacroiliac", {0.087f, 0.905f, 0.0f}},
    {"r_knee", "r_hip", {0.093f, 0.487f, -0.006f}},
    {"r_ankle", "r_knee", {0.096f, 0.078f, 0.022f}},
    {"r_midtarsal", "r_ankle", {0.108f, 0.025f, -0.105f}},
    {"r_sternoclavicular", "vt4", {0.022f, 1.395f, -0.015f}},
    {"r_shoulder", "r_sternoclavicular", {0.172f, 1.395f, 0.018f}},
    {"r_elbow", "r_shoulder", {0.330f, 1.152f, 0.018f}},
    {"r_wrist", "r_elbow", {0.4475f, 0.934f, -0.0145f}},
    {"r_thumb1", "r_wrist", {0.4545f, 0.917f, -0.0455f}},
    {"r_middle1", "r_wrist", {0.4904f, 0.8545f, -0.0265f}},
};

std::string Mirrored(std::string name) {
  if (name.starts_with("r_")) {
    name[0] = 'l';
  }
  return name;
}

void Append(human::Skeleton& skeleton,
            const std::string& name,
            const std::string& parent,
            const glm::vec3& position) {
  human::JointTransform rest;
  rest.translation = position;
  int16_t parent_index = human::Skeleton::kNoParent;
  if (!parent.empty()) {
    parent_index = static_cast<int16_t>(IndexOfJoint(skeleton, parent));
    rest.translation -= RestPosition(skeleton, parent);
  }
  skeleton.names.push_back(name);
  skeleton.parents.push_back(parent_index);
  skeleton.rest.push_back(rest);
  skeleton.joint_from_actor.push_back(glm::translate(glm::mat4(1.0f), -position));
}

}  // namespace

human::Skeleton PlainSkeleton() {
  human::Skeleton skeleton;
  for (const Joint& joint : kMiddle) {
    Append(skeleton, joint.name, joint.parent, joint.position);
  }
  for (const Joint& joint : kRight) {
    Append(skeleton, joint.name, joint.parent, joint.position);
  }
  for (const Joint& joint : kRight) {
    Append(skeleton, Mirrored(joint.name), Mirrored(joint.parent),
           joint.position * glm::vec3(-1.0f, 1.0f, 1.0f));
  }
  const float hip_height = RestPosition(skeleton, "r_hip").y;
  for (const char* panel : kSkirtJoints) {
    Append(skeleton, panel, "sacroiliac", {0.0f, hip_height, 0.0f});
  }
  return skeleton;
}

size_t IndexOfJoint(const human::Skeleton& skeleton, std::string_view name) {
  const auto index = skeleton.Find(name);
  CHECK(index.has_value());
  return *index;
}

glm::vec3 RestPosition(const human::Skeleton& skeleton, std::string_view name) {
  return -glm::vec3(skeleton.joint_from_actor[IndexOfJoint(skeleton, name)][3]);
}

}  // namespace lararium::import
