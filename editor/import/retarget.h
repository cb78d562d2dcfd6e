#pragma once

// A clip of one skeleton for another.

#include <string>

#include "shared/core/status.h"
#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

struct RetargetOptions {
  std::string name;       // of the clip; empty: the source's
  bool lock_feet = true;  // feet that stand in the source stand in the result
  bool take_root = true;  // TakeRootMotion
  bool loop = false;      // cut to the best cycle (FindCycle, CutLoop); an error without one
  float from = 0.0f;      // seconds of the source to use
  float to = 1e9f;
};

// Both skeletons are in the actor frame at rest and bear H-Anim's names (ImportMotion).
//
// Rotations: each joint turns from its rest pose as the source's does from its own, in
// actor axes; limbs first turn so that their bones point as the source's do at rest, which
// makes a figure bound with hanging arms take motion of one bound with spread arms. Spines
// and necks of other lengths are resampled along their way. Feet are calibrated to be
// flat where the source stands. Joints that the source does not have stay at rest.
// Hips: the way of the hip joints above the standing ankles, scaled by leg length
// (Gleicher, Retargetting Motion to New Characters, SIGGRAPH 1998, for the problem and
// its constraints). Feet: held where they stand by two-bone inverse kinematics, the
// correction blended out over the swing (Kovar, Schreiner & Gleicher, Footskate Cleanup,
// SCA 2002); hips sink where a leg would not reach.
//
// Errors: a skeleton without the joints of walking (pelvis, legs), a range without keys,
// a loop that is not there.
Result<human::Clip> Retarget(const human::Skeleton& source,
                             const human::Clip& clip,
                             const human::Skeleton& target,
                             const RetargetOptions& options = {});

}  // namespace lararium::import
