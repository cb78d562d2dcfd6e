#pragma once

// A process beside the player that has a network, which the player has not. It is linked to the
// player by a pair of sockets that keep message boundaries, outlives the shows of a kiosk and ends
// with the player.

#include <sys/types.h>

#include <functional>
#include <span>
#include <string>

#include "shared/core/status.h"

namespace lararium::player {

class CompanionProcess {
 public:
  // Runs `serve` in a new process, which is called `name` in lists of processes. It gets its end of
  // the link and returns the exit code. Of the player's open files it keeps that end and `kept`.
  // Signals that end the player do not end it. Must be called while there is one thread.
  static Result<CompanionProcess> Start(const std::string& name,
                                        std::span<const int> kept,
                                        const std::function<int(int link)>& serve);

  CompanionProcess(CompanionProcess&& other) noexcept;
  CompanionProcess& operator=(CompanionProcess&&) = delete;
  // Closes the link, and ends a process that is still there a second later.
  ~CompanionProcess();

  // The player's end of the link; the children of a kiosk inherit it.
  int link() const { return link_; }
  pid_t process() const { return process_; }

 private:
  CompanionProcess(pid_t process, int link) : process_(process), link_(link) {}

  pid_t process_;
  int link_;
};

}  // namespace lararium::player
