#pragma once

// The capsules that cloth and hair of a person of the cast cannot enter, measured on
// the shaped body: limbs along their bones, the trunk as flat capsules across it.

#include <span>
#include <vector>

#include "editor/import/cast_body.h"

namespace lararium::import {

// skin: the bare body, with weights over skeleton's joints.
std::vector<human::BodyCapsule> MeasureCapsules(const human::Skeleton& skeleton,
                                                const human::SkinnedMesh& skin);

}  // namespace lararium::import
