#pragma once

#include "player/options.h"
#include "shared/core/status.h"

namespace lararium::player {

// Flashes the display, watches it through the camera, and prints how late it is seen.
Status MeasureLatency(const LatencyOptions& options);

}  // namespace lararium::player
