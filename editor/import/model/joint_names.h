#pragma once

// Interprets the name of a bone as a part of the body. Knows the conventions of Mixamo, VRM and
// VRoid, 3ds Max Biped, Character Studio, CMU's motion capture, Unreal, MakeHuman, Rigify,
// Poser and DAZ, and H-Anim itself.

#include <cstdint>
#include <string_view>

namespace lararium::import {

enum class BodySide : uint8_t { kMiddle, kRight, kLeft };

enum class BonePart : uint8_t {
  kUnknown,
  kPelvis,
  kSpine,
  kNeck,
  kHead,
  kJaw,
  kEye,
  kClavicle,
  kShoulder,  // The clavicle in some rigs, the upper arm in others.
  kUpperArm,
  kForearm,
  kHand,
  kHip,  // The thigh in some rigs, an idle joint in others.
  kThigh,
  kLeg,  // The shin in some rigs, the thigh in others.
  kShin,
  kFoot,
  kToes,
  kThumb,
  kIndex,
  kMiddle,
  kRing,
  kLittle,
};

struct BoneName {
  BodySide side = BodySide::kMiddle;
  BonePart part = BonePart::kUnknown;
  int segment = 0;  // Segment of a finger: 1 at the knuckle, 0 the metacarpal.
};

// "mixamorig:LeftForeArm" is the left forearm, "f_index.02.R" the second segment of the right
// index finger. Helper bones (twist, roll, IK, pole, ends) give kUnknown.
BoneName ParseBoneName(std::string_view name);

}  // namespace lararium::import
