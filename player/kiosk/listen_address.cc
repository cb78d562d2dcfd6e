#include "player/kiosk/listen_address.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <charconv>
#include <cstring>
#include <optional>
#include <string>

namespace lararium::player {
namespace {

// The first IPv4 address of a network interface.
std::optional<uint32_t> AddressOfInterface(const std::string& name) {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) {
    return std::nullopt;
  }
  std::optional<uint32_t> found;
  for (const ifaddrs* entry = list; entry != nullptr && !found; entry = entry->ifa_next) {
    if (name == entry->ifa_name && entry->ifa_addr != nullptr &&
        entry->ifa_addr->sa_family == AF_INET) {
      sockaddr_in address = {};
      std::memcpy(&address, entry->ifa_addr, sizeof(address));
      found = ntohl(address.sin_addr.s_addr);
    }
  }
  freeifaddrs(list);
  return found;
}

}  // namespace

Result<ListenAddress> ParseListenAddress(std::string_view option, std::string_view text) {
  const std::string place = std::string(option) + " " + std::string(text);
  const size_t colon = text.rfind(':');
  const std::string_view port = colon == std::string_view::npos ? text : text.substr(colon + 1);
  ListenAddress address{INADDR_LOOPBACK, 0};
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (error != std::errc() || end != port.data() + port.size() || address.port == 0) {
    return Status::Error(place, "has no valid port", "give a number from 1 to 65535");
  }
  if (colon != std::string_view::npos) {
    const std::string where(text.substr(0, colon));
    in_addr ip = {};
    if (inet_pton(AF_INET, where.c_str(), &ip) == 1) {
      address.ip = ntohl(ip.s_addr);
    } else if (const auto of_interface = AddressOfInterface(where)) {
      address.ip = *of_interface;
    } else {
      return Status::Error(place, "'" + where + "' is not an IPv4 address or a network interface",
                           "the command \"ip -4 address\" lists both");
    }
  }
  return address;
}

}  // namespace lararium::player
