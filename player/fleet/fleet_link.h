#pragma once

// The link of a player to its fleet, an MQTT broker with which all players of a site keep a
// connection. It runs in a process of its own, for the reasons of the staff page (staff_page.h):
// the player has no network, and nothing that a visitor sees waits for one.

#include <sys/types.h>

#include <memory>
#include <utility>

#include "player/fleet/fleet_options.h"
#include "player/kiosk/companion_process.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

class FleetLink {
 public:
  // Fails if the options are not valid or a file of theirs cannot be read. A broker that does not
  // answer is no failure. Must be called while there is one thread. Borrows log.
  static Result<std::unique_ptr<FleetLink>> Start(FleetOptions options, bool sandbox, Log& log);

  // The player's end of the link, for StaffLinks::fleet.
  int link() const { return process_.link(); }
  pid_t process() const { return process_.process(); }
  // The device is in a group that plays one drama.
  bool in_group() const { return in_group_; }

 private:
  FleetLink(CompanionProcess process, bool in_group)
      : process_(std::move(process)), in_group_(in_group) {}

  CompanionProcess process_;
  bool in_group_;
};

}  // namespace lararium::player
