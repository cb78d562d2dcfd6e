#pragma once

// A page on the local network on which the staff see the state of a show and, with a PIN, control
// it. It runs in a process of its own with a listening socket and a link to the player; all other
// rights are given up (EnterPageSandbox). So the player, which parses files of others, has no
// network, and the process with network access cannot read anything else on the machine. The page
// outlives the shows of a kiosk.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "player/kiosk/companion_process.h"
#include "player/kiosk/listen_address.h"
#include "player/staff/staff_pin.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

struct StaffPageOptions {
  ListenAddress address;           // port 0: any
  std::filesystem::path pin_file;  // empty: the page is read-only
  bool sandbox = true;
};

class StaffPage {
 public:
  // Must be called while there is one thread. Borrows log.
  static Result<std::unique_ptr<StaffPage>> Start(const StaffPageOptions& options, Log& log);

  // The player's end of the link, for StaffLinks::page.
  int link() const { return process_.link(); }
  uint16_t port() const { return port_; }
  pid_t process() const { return process_.process(); }

 private:
  StaffPage(CompanionProcess process, uint16_t port) : process_(std::move(process)), port_(port) {}

  CompanionProcess process_;
  uint16_t port_;
};

}  // namespace lararium::player
