#pragma once

// The page on the local network by which staff see how a show is doing, and with a PIN look after
// it. It is a process of its own, which has a socket that listens and a link to the player, and may
// do nothing else (EnterPageSandbox): so the player, which reads what others made, has no network,
// and what has a network reads nothing of the machine. It outlives the shows of a kiosk.

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "player/listen_address.h"
#include "player/staff_pin.h"
#include "shared/core/log.h"
#include "shared/core/status.h"

namespace lararium::player {

struct StaffPageOptions {
  ListenAddress address;           // port 0: any
  std::filesystem::path pin_file;  // empty: nobody may change anything
  bool sandbox = true;
};

// Opens the port. Errors: it is taken, or the address is not this machine's.
Result<int> ListenForStaff(const ListenAddress& address);
// How the page is asked for, as far as the machine's addresses are known: for each of them.
std::vector<std::string> StaffPageUrls(const ListenAddress& address);

class StaffPage {
 public:
  // Must be called while there is one thread. Borrows log.
  static Result<std::unique_ptr<StaffPage>> Start(const StaffPageOptions& options, Log& log);
  // Ends it.
  ~StaffPage();
  StaffPage(const StaffPage&) = delete;
  StaffPage& operator=(const StaffPage&) = delete;

  // The player's end, for StaffLink; a kiosk's children inherit it.
  int link() const { return link_; }
  uint16_t port() const { return port_; }
  pid_t process() const { return process_; }

 private:
  StaffPage(pid_t process, int link, uint16_t port) : process_(process), link_(link), port_(port) {}

  pid_t process_;
  int link_;
  uint16_t port_;
};

}  // namespace lararium::player
