#pragma once

// The poses at which a person's light transfer is worked out.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "shared/human/human.h"

namespace lararium::bake {

// Standing (for who can), the rest pose, and then those that are farthest from all before
// among walking and every clip of the person: at most count. How far apart two poses are
// is judged by where the blockers are, seen from the pelvis, the larger ones counting more.
std::vector<std::vector<human::JointTransform>> ChooseKeyPoses(
    std::shared_ptr<const human::Human> human,
    std::span<const human::LightTransfer::Blocker> blockers,
    size_t count);

}  // namespace lararium::bake
