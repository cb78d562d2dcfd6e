#pragma once

// Prefilters the image of a light probe for reflections in rough surfaces.

#include "editor/bake/probe.h"
#include "shared/light/glossy_map.h"

namespace lararium::bake {

// Prefilters an image without its sun (SplitSun) into the layers of a map in stage axes. Each
// texel is the mean of the image weighted by light::GlossyWeight and solid angle, so that
// uniform light keeps its value. Uses all cores and takes about a second.
light::GlossyMap PrefilterProbe(const ProbeImage& sky, const ProbePlacement& placement);

}  // namespace lararium::bake
