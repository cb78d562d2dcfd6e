#pragma once

#include "player/app/options.h"
#include "shared/core/status.h"

namespace lararium::player {

// Flashes the display, watches it through the camera, and prints the latency (see FlashTest).
Status MeasureLatency(const LatencyOptions& options);

}  // namespace lararium::player
