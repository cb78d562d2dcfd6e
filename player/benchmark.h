#pragma once

#include "player/options.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

// Runs the tracker on sequences with ground truth and on images of other places,
// and prints how well it did on stdout. Every frame once, in order; images are
// read and decoded outside the times.
Status Benchmark(const PlayOptions& options, Log& log);

}  // namespace lararium::player
