#pragma once

#include <cstdint>

#include "shared/human/human.h"

namespace lararium::human {

// An adult skeleton of 90 joints with fingers, toes, eyes and jaw. It stands with its arms lowered
// by this angle from the horizontal (0: T-pose). The axes of joints are rotated at random against
// the actor's, by seed (0: no rotation), so that code which assumes certain axes fails.
Human FullBody(float arms_lowered, uint64_t axes_seed);

}  // namespace lararium::human
