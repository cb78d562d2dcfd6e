#pragma once

// The clips of the plain figure.

#include <vector>

#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// The clips walk, idle, look_around and wave for the skeleton of PlainSkeleton(). All keep the
// feet on the floor by inverse kinematics of the legs.
std::vector<human::Clip> PlainClips(const human::Skeleton& skeleton);

}  // namespace lararium::import
