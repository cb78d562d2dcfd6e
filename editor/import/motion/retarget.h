#pragma once

// Retargets a clip from one skeleton to another.

#include <string>

#include "shared/core/status.h"
#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

struct RetargetOptions {
  std::string name;       // Name of the clip; if empty, that of the source.
  bool lock_feet = true;  // Feet that stand in the source stand in the result.
  bool take_root = true;  // TakeRootMotion
  // Cut the clip to its best cycle (FindCycle, CutLoop); an error if there is none.
  bool loop = false;
  float from = 0.0f;  // Range of the source to use, seconds.
  float to = 1e9f;
};

// Both skeletons are in the actor frame at rest and have H-Anim names (ImportMotion).
//
// Rotations: each joint rotates from its rest pose as the joint of the source does from its
// own, in the axes of the actor. Limbs are first rotated so that their bones have the direction
// of the source's at rest; a figure bound with hanging arms can then use motion of one bound
// with spread arms. Spines and necks with other numbers of joints are resampled along their
// length. Feet are calibrated to be flat where the source stands. Joints that the source lacks
// stay at rest. Hips: the path of the hip joints above the standing ankles, scaled by leg
// length (Gleicher, Retargetting Motion to New Characters, SIGGRAPH 1998, for the problem and
// its constraints). Feet: fixed while they stand by two-bone inverse kinematics, with the
// correction blended out over the swing (Kovar, Schreiner & Gleicher, Footskate Cleanup, SCA
// 2002); hips are lowered if a leg would not reach.
//
// Errors: a skeleton that lacks the joints for walking (pelvis, legs), a range without keys, a
// loop that does not exist.
Result<human::Clip> Retarget(const human::Skeleton& source,
                             const human::Clip& clip,
                             const human::Skeleton& target,
                             const RetargetOptions& options = {});

}  // namespace lararium::import
