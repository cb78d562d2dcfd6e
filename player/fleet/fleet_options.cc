#include "player/fleet/fleet_options.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>

#include "player/kiosk/secret_file.h"
#include "shared/core/file.h"

namespace lararium::player {
namespace {

constexpr std::string_view kScheme = "mqtts://";
constexpr std::string_view kForm = "write it as mqtts://HOST/SITE or mqtts://HOST:PORT/SITE";
constexpr size_t kMostName = 64;
constexpr size_t kMostHost = 253;
constexpr size_t kMostPath = 4096;

bool IsIp(const std::string& host) {
  in6_addr address = {};
  return inet_pton(AF_INET, host.c_str(), &address) == 1 ||
         inet_pton(AF_INET6, host.c_str(), &address) == 1;
}

bool IsAlnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

std::string Base(std::string_view site, std::string_view kind, std::string_view name) {
  std::string base = "lararium/";
  base.append(site).append("/").append(kind).append("/").append(name);
  return base;
}

void DescribePath(Fields& fields, std::string_view name, std::filesystem::path& path) {
  std::string text = path.string();
  fields.Text(Optional(name, !text.empty()), text, kMostPath);
  path = text;
}

}  // namespace

bool IsFleetName(std::string_view name) {
  return !name.empty() && name.size() <= kMostName &&
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

Result<FleetAddress> ParseFleetAddress(std::string_view where, std::string_view text) {
  const std::string place = std::string(where) + " " + std::string(text.substr(0, kMostPath));
  if (!text.starts_with(kScheme)) {
    return Status::Error(place, "is not the address of a broker with TLS", kForm);
  }
  text.remove_prefix(kScheme.size());
  const size_t slash = text.find('/');
  std::string_view host = text.substr(0, slash);
  const size_t bracket = host.starts_with('[') ? host.find(']') : 0;
  const size_t colon =
      bracket == std::string_view::npos ? std::string_view::npos : host.find(':', bracket);
  FleetAddress address;
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
    return Status::Error(place, "has no valid host", kForm);
  }
  address.host = host;
  address.site = slash == std::string_view::npos ? "" : text.substr(slash + 1);
  if (!IsFleetName(address.site)) {
    return Status::Error(place, "has no valid name of a site", kForm);
  }
  return address;
}

FleetAddress FleetOptions::broker() const { return *ParseFleetAddress("fleet", address); }

Status FleetOptions::Validate() const {
  LARARIUM_RETURN_IF_ERROR(ParseFleetAddress("fleet", address).status());
  LARARIUM_RETURN_IF_ERROR(CheckFleetName("name in the fleet", name));
  if (!group.empty()) {
    LARARIUM_RETURN_IF_ERROR(CheckFleetName("group in the fleet", group));
  }
  if (password.empty() == certificate.empty() || certificate.empty() != key.empty()) {
    return Status::Error("fleet", "the device cannot prove its name to the broker",
                         "give either a password file, or a certificate and its key");
  }
  for (const std::filesystem::path& secret : {password, key}) {
    if (!secret.empty()) {
      LARARIUM_RETURN_IF_ERROR(CheckSecretFile(secret));
    }
  }
  for (const std::filesystem::path& file : {authority, password, certificate, key}) {
    if (!file.empty() && !FileExists(file)) {
      return Status::Error(file.string(), "is missing", "copy the device's folder of the fleet");
    }
  }
  return Status();
}

void DescribeFields(Fields& fields, FleetOptions& options) {
  fields.Text("address", options.address, kMostPath);
  fields.Check(fields.reading()
                   ? ParseFleetAddress(fields.where("address"), options.address).status()
                   : Status());
  fields.Text(Optional("name", !options.name.empty()), options.name, kMostName);
  fields.Text(Optional("group", !options.group.empty()), options.group, kMostName);
  fields.Flag(Optional("guide", options.guide), options.guide);
  DescribePath(fields, "authority", options.authority);
  DescribePath(fields, "password", options.password);
  DescribePath(fields, "certificate", options.certificate);
  DescribePath(fields, "key", options.key);
}

void ResolvePaths(const std::filesystem::path& folder, FleetOptions& options) {
  for (std::filesystem::path* path :
       {&options.authority, &options.password, &options.certificate, &options.key}) {
    if (!path->empty()) {
      *path = folder / *path;
    }
  }
}

void NameDevice(FleetOptions& options) {
  char name[256] = "";
  if (options.name.empty() && ::gethostname(name, sizeof(name) - 1) == 0) {
    options.name = std::string(name).substr(0, std::string_view(name).find('.'));
  }
}

std::string DeviceCommands(std::string_view site, std::string_view name) {
  return Base(site, "device", name) + "/do";
}

std::string GroupCommands(std::string_view site, std::string_view group) {
  return Base(site, "group", group) + "/do";
}

FleetTopics TopicsOf(std::string_view site, std::string_view name, std::string_view group) {
  const std::string base = Base(site, "device", name);
  FleetTopics topics;
  topics.state = base + "/state";
  topics.presence = base + "/presence";
  topics.statistics = base + "/statistics";
  topics.commands = {DeviceCommands(site, name)};
  if (!group.empty()) {
    topics.commands.push_back(GroupCommands(site, group));
    const std::string together = Base(site, "group", group);
    const std::string own(name);
    topics.to_all = together + "/all/" + own;
    topics.from_all = together + "/all/+";
    topics.to_one = together + "/to/+/" + own;
    topics.from_one = together + "/to/" + own + "/+";
    topics.presences = Base(site, "device", "+") + "/presence";
  }
  return topics;
}

}  // namespace lararium::player
