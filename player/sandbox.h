#pragma once

// Gives up what playing a show never needs of the system, so that a show that breaks out of its
// readers finds little: no other programs, no network, no other processes, no settings of the
// machine.

#include "shared/core/status.h"

namespace lararium::player {

// Both are for this process, all its threads, and for good (seccomp, Linux). What is forbidden
// fails as if the user lacked the right. An error where the system has no seccomp: the show can go
// on without.

// Before the show is read: what opening devices and drivers needs is left, other programs and
// sockets among it.
Status EnterOpeningSandbox();
// When devices and drivers are open.
Status EnterSandbox();

// For the process of the staff page (staff_page.h), which is all that strangers reach: it may take
// connections of the one socket that listens, speak with who has come, and have memory. It opens
// no file and no socket and connects to nobody.
Status EnterPageSandbox(int listening);

}  // namespace lararium::player
