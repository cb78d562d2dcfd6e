#include "shared/bundle/fleet_address.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cctype>
#include <charconv>

namespace lararium::bundle {
namespace {

constexpr size_t kMostFleetName = 64;
constexpr size_t kMostHost = 253;
constexpr size_t kMostToldAddress = 4096;

bool IsIp(const std::string& host) {
  in6_addr address = {};
  return inet_pton(AF_INET, host.c_str(), &address) == 1 ||
         inet_pton(AF_INET6, host.c_str(), &address) == 1;
}

bool IsAlnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

}  // namespace

bool IsFleetName(std::string_view name) {
  return !name.empty() && name.size() <= kMostFleetName &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return IsAlnum(c) || c == '_' || c == '-'; });
}

Status CheckFleetName(std::string_view where, std::string_view name) {
  return IsFleetName(name)
             ? Status()
             : Status::Error(where, "\"" + std::string(name) + "\" is not a valid name",
                             "use 1 to 64 letters, digits, \"_\" and \"-\", such as \"tablet-07\"");
}

bool IsHost(std::string_view host) {
  return IsIp(std::string(host)) ||
         (!host.empty() && host.size() <= kMostHost && IsAlnum(host.front()) &&
          std::all_of(host.begin(), host.end(),
                      [](char c) { return IsAlnum(c) || c == '.' || c == '-'; }));
}

Result<FleetAddress> ParseFleetAddress(std::string_view where,
                                       std::string_view text,
                                       const FleetScheme& scheme) {
  const std::string place =
      std::string(where) + " " + std::string(text.substr(0, kMostToldAddress));
  const std::string begin = std::string(scheme.name) + "://";
  const std::string form = "write it as " + begin + "HOST/SITE or " + begin + "HOST:PORT/SITE";
  if (!text.starts_with(begin)) {
    return Status::Error(place, "is not the address of a broker with TLS", form);
  }
  text.remove_prefix(begin.size());
  const size_t slash = text.find('/');
  std::string_view host = text.substr(0, slash);
  const size_t bracket = host.starts_with('[') ? host.find(']') : 0;
  const size_t colon =
      bracket == std::string_view::npos ? std::string_view::npos : host.find(':', bracket);
  FleetAddress address;
  address.port = scheme.port;
  if (colon != std::string_view::npos) {
    const std::string_view port = host.substr(colon + 1);
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
    if (error != std::errc() || end != port.data() + port.size() || address.port == 0) {
      return Status::Error(place, "has no valid port", "give a number from 1 to 65535");
    }
    host = host.substr(0, colon);
  }
  if (bracket != 0 && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
  }
  if (!IsHost(host)) {
    return Status::Error(place, "has no valid host", form);
  }
  address.host = host;
  address.site = slash == std::string_view::npos ? "" : text.substr(slash + 1);
  if (!IsFleetName(address.site)) {
    return Status::Error(place, "has no valid name of a site", form);
  }
  return address;
}

}  // namespace lararium::bundle
