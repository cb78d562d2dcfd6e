#pragma once

// Moves the travel of a clip from its keys to its stride: walking clips stay in place and state
// their stride, as human::Clip requires.

#include <cstddef>
#include <optional>
#include <utility>

#include "shared/human/clip.h"
#include "shared/human/skeleton.h"

namespace lararium::import {

// A clip that travels straight is rotated to travel along -Z (backwards: +Z, with a negative
// stride), and its travel is removed. A clip that loops in place, as on a treadmill, gets the
// stride of its standing feet. Other clips, and skeletons that do not walk, stay unchanged.
// Returns whether the clip has a stride now.
bool TakeRootMotion(const human::Skeleton& skeleton, human::Clip& clip);

// Gives the first and last key of the best cycle in a periodic clip, by the similarity of poses
// and their velocities. Gives nullopt if no two keys within the limits are similar.
struct CycleLength {
  float least = 0.5f, most = 4.0f;  // seconds
};
std::optional<std::pair<size_t, size_t>> FindCycle(const human::Skeleton& skeleton,
                                                   const human::Clip& clip,
                                                   const CycleLength& length = {});

// Keeps the keys from `first` to `last` and distributes the difference between these two over
// all, so that the clip loops. Horizontal travel of joints without a parent is kept, not
// closed; remove it first.
void CutLoop(const human::Skeleton& skeleton, size_t first, size_t last, human::Clip& clip);

}  // namespace lararium::import
