#pragma once

// The address of a fleet's broker, for devices and for pages in browsers.

#include <cstdint>
#include <string>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::bundle {

// The broker, and the site whose devices it connects.
struct FleetAddress {
  std::string host;
  uint16_t port = 0;
  std::string site;
};

// How a client speaks with the broker, always with TLS.
struct FleetScheme {
  std::string_view name;
  uint16_t port = 0;  // The port of addresses that name none.
};
inline constexpr FleetScheme kDeviceScheme = {"mqtts", 8883};
// Pages in browsers have WebSockets only.
inline constexpr FleetScheme kPageScheme = {"wss", 443};

// 1 to 64 letters, digits, "_" and "-": sites, devices and groups, which are parts of topics.
bool IsFleetName(std::string_view name);
Status CheckFleetName(std::string_view where, std::string_view name);
// True for an IP address, or for a name that has only characters of host names.
bool IsHost(std::string_view host);

// Parses "SCHEME://HOST[:PORT]/SITE"; an IPv6 address stands in brackets. where: see Status.
Result<FleetAddress> ParseFleetAddress(std::string_view where,
                                       std::string_view text,
                                       const FleetScheme& scheme = kDeviceScheme);

}  // namespace lararium::bundle
