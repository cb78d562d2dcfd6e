#pragma once

// How the plain figure moves.

#include <vector>

#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// Clips walk, idle, look_around and wave for the skeleton of PlainSkeleton().
// All bring the feet to the floor by inverse kinematics of the legs.
std::vector<human::Clip> PlainClips(const human::Skeleton& skeleton);

}  // namespace lararium::import
