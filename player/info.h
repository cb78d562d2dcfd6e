#pragma once

#include "player/options.h"
#include "shared/core/status.h"

namespace lararium::player {

// Verifies a bundle and prints what it holds on stdout.
Status PrintInfo(const InfoOptions& options);

}  // namespace lararium::player
