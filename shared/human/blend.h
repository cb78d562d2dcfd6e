#pragma once

// Layers of poses: masks of joints, additive layers.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/human/body_rig.h"
#include "shared/human/skeleton.h"

namespace lararium::human {

// The part of a body that a clip moves.
enum class BodyPart : uint8_t { kWhole, kUpper, kArms, kHead };
inline constexpr int kBodyPartCount = 4;

// A weight 0..1 for each joint.
using JointMask = std::vector<float>;
using JointMasks = std::array<JointMask, kBodyPartCount>;  // index: BodyPart
JointMasks MakeJointMasks(const Skeleton& skeleton, const BodyRig& body);

// Blends joint by joint: pose = (1 - w) * pose + w * other, with w = weight * mask[joint].
// Rotations take the shorter arc.
void BlendPose(std::span<JointTransform> pose,
               std::span<const JointTransform> other,
               float weight,
               std::span<const float> mask);

}  // namespace lararium::human
