#pragma once

// A black window over a kiosk's monitor, in a process of its own. Visitors see it before the show
// has started and while the show is restarted after a failure.

#include <sys/types.h>

#include "shared/core/log.h"

namespace lararium::player {

class Curtain {
 public:
  // Call this while the process has one thread. If no window can be opened, the log says so and
  // there is no curtain.
  Curtain(int monitor, Log& log);
  ~Curtain();
  Curtain(const Curtain&) = delete;
  Curtain& operator=(const Curtain&) = delete;

 private:
  pid_t process_;
};

}  // namespace lararium::player
