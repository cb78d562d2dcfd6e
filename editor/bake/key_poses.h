#pragma once

// The poses at which a person's light transfer is worked out.

#include <cstddef>
#include <memory>
#include <vector>

#include "shared/human/human.h"

namespace lararium::bake {

// The rest pose, standing, and then those that are farthest from all before (by where
// the joints are, seen from the pelvis) among walking and every clip of the person: at
// most count.
std::vector<std::vector<human::JointTransform>> ChooseKeyPoses(
    std::shared_ptr<const human::Human> human, size_t count);

}  // namespace lararium::bake
