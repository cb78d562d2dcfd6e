#pragma once

// How a device joins a fleet: the players of a site that one MQTT broker connects.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "shared/bundle/fleet_address.h"
#include "shared/core/json_fields.h"
#include "shared/core/status.h"

namespace lararium::player {

using bundle::CheckFleetName;
using bundle::FleetAddress;
using bundle::IsFleetName;
using bundle::IsHost;
using bundle::ParseFleetAddress;

struct FleetOptions {
  std::string address;  // "mqtts://HOST[:PORT]/SITE"; empty: the device belongs to no fleet.
  std::string name;     // Name of the device; empty: that of the machine.
  std::string group;    // Group that plays one drama; empty: none.
  bool guide = false;   // The device of the group's guide.
  // Certificate of the authority that signed the broker's; empty: those that the system trusts.
  std::filesystem::path authority;
  // How the device proves its name, either by a password (first line of a file) or by a
  // certificate and its key (PEM).
  std::filesystem::path password;
  std::filesystem::path certificate;
  std::filesystem::path key;

  FleetAddress broker() const;  // Requires Validate().
  Status Validate() const;

  friend bool operator==(const FleetOptions&, const FleetOptions&) = default;
};

// Describes the field `fleet` of a device file. Paths are relative to its folder.
void DescribeFields(Fields& fields, FleetOptions& options);
// Makes relative paths begin at `folder`.
void ResolvePaths(const std::filesystem::path& folder, FleetOptions& options);
// Uses the name of the machine where options have none.
void NameDevice(FleetOptions& options);

// The topics of a device (docs/file-formats.md). A visitor's page in a browser is a device whose
// name begins with "page/". That is a level of its own of a topic, so that the broker lets no page
// take the name of a device.
struct FleetTopics {
  std::string state;                  // Retained. Written by the device.
  std::string presence;               // Retained. Written by the device, or as its last will.
  std::string statistics;             // Retained. Written by the device.
  std::vector<std::string> commands;  // Topics of the device and of its group.
  // Topics within a group are empty without one. Members write to all, or to one whose name stands
  // in place of "+", under their own names. They hear what devices and pages write, and whether
  // these are there.
  std::string to_all;
  std::string to_one;
  std::vector<std::string> heard;
  std::vector<std::string> presences;
};
FleetTopics TopicsOf(std::string_view site, std::string_view name, std::string_view group);
// Topic of the commands to one device, or to a group.
std::string DeviceCommands(std::string_view site, std::string_view name);
std::string GroupCommands(std::string_view site, std::string_view group);

}  // namespace lararium::player
