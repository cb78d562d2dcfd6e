#pragma once

// A black picture over a kiosk's monitor, from a process of its own: what a visitor sees where
// there is no show, before it has begun, and while it is begun again after a failure.

#include <sys/types.h>

#include "shared/core/log.h"

namespace lararium::player {

class Curtain {
 public:
  // While there is one thread. Where no window can be opened there is none, and the log says so.
  Curtain(int monitor, Log& log);
  ~Curtain();
  Curtain(const Curtain&) = delete;
  Curtain& operator=(const Curtain&) = delete;

 private:
  pid_t process_;
};

}  // namespace lararium::player
