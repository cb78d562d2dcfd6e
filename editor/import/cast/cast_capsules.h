#pragma once

// Measures on a shaped body the capsules that cloth and hair cannot enter: limbs along their
// bones, the trunk as flat capsules across it.

#include <vector>

#include "editor/import/cast/cast_body.h"

namespace lararium::import {

// `skin` is the bare body with weights over the joints of `skeleton`.
std::vector<human::BodyCapsule> MeasureCapsules(const human::Skeleton& skeleton,
                                                const human::SkinnedMesh& skin);

}  // namespace lararium::import
