#pragma once

// The address and port on which a service of the player listens.

#include <cstdint>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::player {

struct ListenAddress {
  uint32_t ip = 0;  // host byte order; 0: all interfaces of this machine
  uint16_t port = 0;
};

// Parses "9000" (only for programs of this machine), "192.168.1.5:9000", "wlan0:9000" or
// "0.0.0.0:9000". option: name of the option in errors, such as "--osc".
Result<ListenAddress> ParseListenAddress(std::string_view option, std::string_view text);

}  // namespace lararium::player
