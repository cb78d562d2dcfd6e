#pragma once

// What the name of a bone says about its place in a body, in the manners of Mixamo,
// VRM and VRoid, 3ds Max Biped, Character Studio, CMU's motion capture, Unreal,
// MakeHuman, Rigify, Poser and DAZ, and H-Anim itself.

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
  kShoulder,  // the clavicle of some rigs, the upper arm of others
  kUpperArm,
  kForearm,
  kHand,
  kHip,  // the thigh of some rigs, an idle joint of others
  kThigh,
  kLeg,  // the shin of some rigs, the thigh of others
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
  int segment = 0;  // of a finger: 1 at the knuckle, 0 the metacarpal
};

// "mixamorig:LeftForeArm" is the left forearm, "f_index.02.R" the second segment of the
// right index finger. Helpers (twist, roll, IK, pole, ends) are unknown.
BoneName ParseBoneName(std::string_view name);

}  // namespace lararium::import
