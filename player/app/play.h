#pragma once

#include <chrono>

#include "player/app/options.h"
#include "player/kiosk/watchdog.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

// Runs a show until its source ends, the window closes, or the process gets SIGINT or SIGTERM.
// started: start time of the program, for the statistics. start and heartbeat: only for the show of
// a kiosk (watchdog.h). staff_link: StaffPage::link(); -1: there is no staff page.
Status Play(const PlayOptions& options,
            std::chrono::steady_clock::time_point started,
            Log& log,
            const ChildStart& start = {},
            Heartbeat heartbeat = Heartbeat(),
            int staff_link = -1);

}  // namespace lararium::player
