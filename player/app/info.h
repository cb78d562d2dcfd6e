#pragma once

#include "player/app/options.h"
#include "shared/core/status.h"

namespace lararium::player {

// Verifies a bundle and prints its contents on stdout.
Status PrintInfo(const InfoOptions& options);

}  // namespace lararium::player
