#pragma once

// Where a service of the player listens.

#include <cstdint>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::player {

struct ListenAddress {
  uint32_t ip = 0;  // host's byte order; 0: all interfaces of this machine
  uint16_t port = 0;
};

// "9000" (this machine's programs only), "192.168.1.5:9000", "wlan0:9000", "0.0.0.0:9000".
// option: what errors call it, as "--osc".
Result<ListenAddress> ParseListenAddress(std::string_view option, std::string_view text);

}  // namespace lararium::player
