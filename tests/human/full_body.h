#pragma once

#include <cstdint>

#include "shared/human/human.h"

namespace lararium::human {

// A grown person's skeleton of 90 joints with fingers, toes, eyes and jaw, standing
// with its arms lowered by this angle from the horizontal (0: T-pose). Axes of joints
// are turned at random, by seed, against the actor's (0: not at all), so that whatever
// supposes axes fails.
Human FullBody(float arms_lowered, uint64_t axes_seed);

}  // namespace lararium::human
