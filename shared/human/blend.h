#pragma once

// Layers of poses: masks of joints, additive layers.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/human/body.h"
#include "shared/human/skeleton.h"

namespace lararium::human {

// Of a body, for what a clip moves.
enum class BodyPart : uint8_t { kWhole, kUpper, kArms, kHead };
inline constexpr int kBodyPartCount = 4;

// A weight 0..1 for each joint.
using JointMask = std::vector<float>;
using JointMasks = std::array<JointMask, kBodyPartCount>;  // by BodyPart
JointMasks MakeJointMasks(const Skeleton& skeleton, const Body& body);

// pose = (1 - w) * pose + w * other with w = weight * mask of each joint, rotations on
// the shorter arc.
void BlendPose(std::span<JointTransform> pose,
               std::span<const JointTransform> other,
               float weight,
               std::span<const float> mask);

// pose = pose followed by weight times the way from reference to layer, joint by joint
// in the joint's own frame.
void AddPose(std::span<JointTransform> pose,
             std::span<const JointTransform> reference,
             std::span<const JointTransform> layer,
             float weight);

}  // namespace lararium::human
