#pragma once

// Chooses the poses at which the light transfer of a person is baked.

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "shared/human/human.h"

namespace lararium::bake {

// Gives at most `count` poses: standing (if the person can stand), the rest pose, then poses
// from walking and from all clips of the person, each the farthest from those already chosen.
// The distance of two poses is that of the blockers relative to the pelvis, larger blockers
// weighted more.
std::vector<std::vector<human::JointTransform>> ChooseKeyPoses(
    std::shared_ptr<const human::Human> human,
    std::span<const human::LightTransfer::Blocker> blockers,
    size_t count);

}  // namespace lararium::bake
