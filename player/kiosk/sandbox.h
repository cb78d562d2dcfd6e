#pragma once

// Gives up rights of the process that playing a show does not need. If a malicious show exploits a
// parser, it can then reach no other programs, no network, no other processes and no settings of
// the machine.

#include <cstdint>
#include <filesystem>
#include <span>

#include "shared/core/status.h"

namespace lararium::player {

// Each sandbox applies to all threads of this process and cannot be undone (seccomp, Linux).
// Forbidden system calls fail as if the user lacked the right. The functions return an error if the
// system has no seccomp; the show can be played without it.

// Call this before the show is read. It still allows what devices and drivers need while they are
// opened, including starting programs and opening sockets.
Status EnterOpeningSandbox();
// Call this when devices and drivers are open.
Status EnterSandbox();

// For the process that fetches updates (updater.h). It may connect to other machines and write
// files. It cannot start programs or wait for connections.
Status EnterUpdateSandbox();

// For the process of the staff page (staff_page.h), the only one that other machines can reach. It
// may accept connections on the listening socket, use these connections and allocate memory. It
// cannot open files or sockets or connect to other machines.
Status EnterPageSandbox(int listening);

// For the process of the fleet (fleet_link.h), which connects to one broker. It may find the
// address of a name, connect to `port` over TCP, use its connections, allocate memory, and read
// `files` and what the resolver of names reads. It cannot write files, accept connections or reach
// programs of this machine. Before Linux 6.7 it could connect to other ports too, and without
// Landlock it could read other files; the latter is an error after everything else was entered.
Status EnterClientSandbox(std::span<const std::filesystem::path> files, uint16_t port);

}  // namespace lararium::player
