#include "shared/human/blend.h"

#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>

#include "shared/core/check.h"

namespace lararium::human {
namespace {

// Fills joints that have no weight of their own with their parent's weight.
void FillDown(const Skeleton& skeleton, JointMask& mask) {
  for (size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] < 0.0f) {
      const int16_t parent = skeleton.parents[i];
      mask[i] = parent == Skeleton::kNoParent ? 0.0f : mask[static_cast<size_t>(parent)];
    }
  }
}

constexpr float kAsParent = -1.0f;

void Mark(JointMask& mask, JointIndex joint, float weight) {
  if (joint != kNoJoint) {
    mask[static_cast<size_t>(joint)] = weight;
  }
}

}  // namespace

JointMasks MakeJointMasks(const Skeleton& skeleton, const BodyRig& body) {
  JointMasks masks;
  for (JointMask& mask : masks) {
    mask.assign(skeleton.size(), kAsParent);
  }
  masks[static_cast<size_t>(BodyPart::kWhole)].assign(skeleton.size(), 1.0f);
  JointMask& upper = masks[static_cast<size_t>(BodyPart::kUpper)];
  // The weight grows along the spine, so that the pelvis keeps walking below it.
  for (size_t i = 0; i < body.spine.size(); ++i) {
    Mark(upper, body.spine[i], static_cast<float>(i + 1) / static_cast<float>(body.spine.size()));
  }
  for (const BodyRig::Leg& leg : body.legs) {
    Mark(upper, leg.hip, 0.0f);
  }
  JointMask& arms = masks[static_cast<size_t>(BodyPart::kArms)];
  for (const BodyRig::Arm& arm : body.arms) {
    Mark(arms, arm.clavicle != kNoJoint ? arm.clavicle : arm.shoulder, 1.0f);
  }
  JointMask& head = masks[static_cast<size_t>(BodyPart::kHead)];
  for (size_t i = 0; i < body.neck.size(); ++i) {
    Mark(head, body.neck[i], static_cast<float>(i + 1) / static_cast<float>(body.neck.size()));
  }
  for (JointMask& mask : masks) {
    FillDown(skeleton, mask);
  }
  return masks;
}

void BlendPose(std::span<JointTransform> pose,
               std::span<const JointTransform> other,
               float weight,
               std::span<const float> mask) {
  CHECK(pose.size() == other.size() && pose.size() == mask.size());
  for (size_t joint = 0; joint < pose.size(); ++joint) {
    const float w = weight * mask[joint];
    if (w <= 0.0f) {
      continue;
    }
    pose[joint].rotation = glm::slerp(pose[joint].rotation, other[joint].rotation, w);
    pose[joint].translation = glm::mix(pose[joint].translation, other[joint].translation, w);
    pose[joint].scale = glm::mix(pose[joint].scale, other[joint].scale, w);
  }
}

}  // namespace lararium::human
