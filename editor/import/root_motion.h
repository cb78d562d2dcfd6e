#pragma once

// How far a clip goes, taken out of its keys: walking clips stay in place and carry their
// stride, as human::Clip wants it.

#include <cstddef>
#include <optional>
#include <utility>

#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// A clip that travels straight on is turned to travel along -Z (backwards: +Z, with a
// negative stride) and loses that; one that loops on the spot like on a treadmill gets the
// stride of its standing feet. Others, and skeletons that do not walk, stay as they are.
// True where the clip has a stride now.
bool TakeRootMotion(const human::Skeleton& skeleton, human::Clip& clip);

// The first and last key of the best cycle of a clip that is periodic: poses and their
// change agree. Empty where no two keys that far apart are alike.
struct CycleLength {
  float least = 0.5f, most = 4.0f;  // seconds
};
std::optional<std::pair<size_t, size_t>> FindCycle(const human::Skeleton& skeleton,
                                                   const human::Clip& clip,
                                                   const CycleLength& length = {});

// Keeps keys first to last, and spreads what is missing between these over all: the clip
// loops. Horizontal travel (of joints without a parent) is not closed but kept: take it
// out first.
void CutLoop(const human::Skeleton& skeleton, size_t first, size_t last, human::Clip& clip);

}  // namespace lararium::import
