#pragma once

#include <chrono>
#include <functional>

#include "player/app/options.h"
#include "player/kiosk/watchdog.h"
#include "player/staff/staff_link.h"
#include "player/updates/update_watch.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

// Why a show has ended: it is over, or the watchdog is to start the player again.
enum class PlayEnd { kOver, kStartAgain };

// Parts that only some runs of a show have.
struct PlayLinks {
  // A kiosk has these two (watchdog.h).
  ChildStart start = {};
  Heartbeat heartbeat = Heartbeat();
  StaffLinks staff = {};                       // Links to the processes that show its state.
  UpdateWatch* updates = nullptr;              // nullptr: there are no updates.
  std::function<void()> look_for_update = {};  // Empty: there are no updates.
  bool in_group = false;  // The fleet's process plays one drama with other devices.
};

// Runs a show until its source ends, the window closes, the process gets SIGINT or SIGTERM, or it
// is to be started again. started: start time of the program, for the statistics.
Result<PlayEnd> Play(const PlayOptions& options,
                     std::chrono::steady_clock::time_point started,
                     Log& log,
                     const PlayLinks& links = {});

}  // namespace lararium::player
