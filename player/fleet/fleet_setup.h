#pragma once

// Writes what a site needs for its fleet (docs/how-to-run-a-fleet.md): the configuration of the
// broker Mosquitto with accounts and rights, an authority with certificates, and a folder for each
// device.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/json_fields.h"
#include "shared/core/status.h"

namespace lararium::player {

struct FleetDevice {
  std::string name;
  std::string group;   // Empty: none.
  bool guide = false;  // Leads its group.
};

// The fleet as fleet.json of its folder has it (docs/file-formats.md).
struct FleetPlan {
  static constexpr size_t kMostDevices = 1000;
  static constexpr char kStaff[] = "staff";        // The account of fleet pages.
  static constexpr char kVisitors[] = "visitors";  // The account of visitors' pages.

  std::string host;  // IP address or name of the broker, as devices reach it.
  std::string site;
  uint16_t port = 8883;       // The port of devices.
  uint16_t page_port = 8884;  // The port of fleet pages, by WebSocket.
  // The folder in which the broker's files will lie on its machine.
  std::string broker_folder = "/etc/mosquitto/lararium";
  bool certificates = false;  // Devices prove their names by certificates, else by passwords.
  std::vector<FleetDevice> devices;
};
Result<FleetPlan> ParseFleetPlan(std::string_view text, const std::string& where);

// The changes to be made to a folder's fleet. Empty values stay as they are.
struct FleetSetupOptions {
  std::filesystem::path folder;
  std::string host;
  std::string site;
  std::optional<uint16_t> port;
  std::optional<uint16_t> page_port;
  std::string broker_folder;
  std::optional<bool> certificates;
  std::vector<std::string> devices;  // Added, or given another group: "NAME" or "NAME:GROUP".
  std::vector<std::string> guides;   // Names of devices that lead their groups from now on.
  std::vector<std::string> removed;  // Names.
  std::filesystem::path show;        // The bundle whose places are shown as plans; empty: none.
  // Static files of the fleet's page, which are copied; a missing folder is left out.
  std::filesystem::path page;
};

// Writes the folder. The authority, and passwords and certificates of devices that it has already,
// stay. Files can be read by their owner only. Returns the number of devices.
Result<size_t> SetUpFleet(const FleetSetupOptions& options);

}  // namespace lararium::player
