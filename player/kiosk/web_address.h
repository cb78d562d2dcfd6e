#pragma once

// Ports on which pages are served, and their addresses in browsers.

#include <string>
#include <string_view>
#include <vector>

#include "player/kiosk/listen_address.h"
#include "shared/core/status.h"

namespace lararium::player {

// Opens the port and returns its socket. Fails if the port is in use or the address does not belong
// to this machine. page: name of the page in errors; option: the option that gave the address.
Result<int> ListenForPage(std::string_view page,
                          std::string_view option,
                          const ListenAddress& address);
// URLs of a page, one for each known address of the machine. scheme: "http" or "https".
std::vector<std::string> PageUrls(std::string_view scheme, const ListenAddress& address);

}  // namespace lararium::player
