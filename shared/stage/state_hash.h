#pragma once

// A hash of what a stage shows, by which devices that play one drama compare themselves.

#include <cstdint>

#include "shared/stage/stage.h"

namespace lararium::stage {

// Where people and objects are and what they do, what is said and heard. Mouths are left out, which
// move in the language that a device has chosen.
uint64_t HashState(const StageSnapshot& snapshot);

}  // namespace lararium::stage
