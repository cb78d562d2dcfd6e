#pragma once

// A probe's image as rough surfaces mirror it.

#include "editor/bake/probe.h"
#include "shared/light/glossy_map.h"

namespace lararium::bake {

// Prefilters an image, from which the sun has been taken (SplitSun), into the layers of a map
// in stage axes. Each texel is the mean of the image weighed by light::GlossyWeight and solid
// angle, so that even light stays as it is. All cores; about a second.
light::GlossyMap PrefilterProbe(const ProbeImage& sky, const ProbePlacement& placement);

}  // namespace lararium::bake
