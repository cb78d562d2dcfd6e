#pragma once

// Gives up what playing a show never needs of the system, so that a show that breaks out of its
// readers finds little: no other programs, no network, no other processes, no settings of the
// machine.

#include "shared/core/status.h"

namespace lararium::player {

// For this process, all its threads, and for good (seccomp, Linux). What is forbidden fails as if
// the user lacked the right. Call it when devices and drivers are open. An error where the system
// has no seccomp: the show can go on without.
Status EnterSandbox();

}  // namespace lararium::player
