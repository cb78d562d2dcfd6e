#pragma once

#include <chrono>

#include "player/options.h"
#include "player/watchdog.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

// Runs a show until its source ends, the window closes, or the process is asked
// to end (SIGINT, SIGTERM). started: when the program did, for the statistics.
// start, heartbeat: of a kiosk's show (watchdog.h). staff_link: of its StaffPage; -1: it has none.
Status Play(const PlayOptions& options,
            std::chrono::steady_clock::time_point started,
            Log& log,
            const ChildStart& start = {},
            Heartbeat heartbeat = Heartbeat(),
            int staff_link = -1);

}  // namespace lararium::player
