// fleet_devices FOLDER [NAME...]: joins the fleet with the devices of a folder that fleet-setup
// wrote, until it is killed. Each publishes a state twice a second, as a player does, with values
// of its own; of several, the last is silent after its first state. Prints a line for each command
// and each note: NAME TEXT.
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "player/app/device_file.h"
#include "player/fleet/fleet_client.h"
#include "player/fleet/fleet_options.h"
#include "player/kiosk/visit_statistics.h"
#include "player/staff/staff_messages.h"
#include "player/staff/staff_state.h"

namespace {

using namespace lararium;          // NOLINT: a program of its own
using namespace lararium::player;  // NOLINT

constexpr double kInterval = 0.5;  // seconds between states

// What device `index` of `count` says at a moment.
std::string StateOf(size_t index, double seconds) {
  const auto phase = static_cast<double>(index);
  StaffState state;
  state.title = "Thermopolium";
  state.show = index % 10 == 3 ? "aaaaaaaaaaaa" : "0123456789ab";
  state.place = "thermopolium";
  state.position = {2.0 * std::cos(phase + 0.1 * seconds), 1.6,
                    2.0 * std::sin(phase + 0.1 * seconds)};
  state.seconds = seconds;
  state.length = 235.0;
  state.kiosk = true;
  state.visitor = index % 3 != 0;
  state.tracking = vision::TrackState::kTracking;
  state.tracked = state.tracked_minute = 0.97;
  state.frames_per_second = 30.0;
  state.audible = true;
  state.languages = {"la", "it"};
  state.caption_languages = {"en", "it"};
  StaffMachine machine;
  machine.celsius = index % 10 == 5 ? 85.0 : 50.0 + static_cast<double>(index % 7);
  machine.battery = Battery{index % 10 == 7 ? 0.08 : 0.8, false};
  machine.memory_mib = 240.0;
  return StaffJson(state, machine);
}

// The visits of three days. Their number falls from device to device; the last devices have fewer
// than ten in a day.
VisitStatistics StatisticsOf(size_t index) {
  VisitStatistics statistics;
  for (int day = 0; day < 3; ++day) {
    DayCounts& counts = statistics.Day("2026-11-2" + std::to_string(5 + day));
    VisitDetails details;
    const int visits = 20 * (day + 2) - static_cast<int>(index);
    for (int i = 0; i < visits; ++i) {
      VisitSummary visit;
      visit.drama_seconds = i % 3 == 0 ? 100.0 : 235.0;
      visit.seconds = visit.drama_seconds + (i % 5 == 0 ? 120.0 : 0.0);
      visit.language = i % 2 == 0 ? "la" : "it";
      visit.captions = i % 4 == 0 ? "off" : i % 4 == 1 ? "en" : "it";
      for (int x = -1; x <= 1; ++x) {
        if (i % (x + 2) == 0) {
          visit.lost.push_back({"thermopolium", x, day});
        }
      }
      AddVisit(visit, details);
      ++counts.visitors;
      counts.completed += visit.drama_seconds > 200.0 ? 1 : 0;
      counts.played_seconds += visit.seconds;
      counts.seen_seconds += visit.seconds;
      counts.tracked_seconds += 0.95 * visit.seconds;
      counts.losses += static_cast<int64_t>(visit.lost.size());
    }
    counts.details = std::move(details);
  }
  return statistics;
}

struct SimulatedDevice {
  std::string name;
  int player = -1;  // The player's end of the link.
  std::unique_ptr<FleetClient> client;
  std::thread thread;
};

// Starts the client of a device. nullptr: its folder is not as fleet-setup writes it.
std::unique_ptr<SimulatedDevice> StartDevice(const std::filesystem::path& folder) {
  const auto device = LoadDevice(folder / "device.json");
  int ends[2];
  if (!device.ok() || !device->fleet || ::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0) {
    return nullptr;
  }
  auto client = FleetClient::Create(*device->fleet, ends[1]);
  if (!client.ok()) {
    std::fprintf(stderr, "%s\n", client.message().c_str());
    return nullptr;
  }
  auto started = std::make_unique<SimulatedDevice>();
  started->name = folder.filename().string();
  started->player = ends[0];
  started->client = *std::move(client);
  started->thread = std::thread([running = started->client.get()] { running->Run(); });
  return started;
}

void PrintCommands(const SimulatedDevice& device, std::string& buffer) {
  bool open = true;
  while (const auto message = ReceiveStaffMessage(device.player, buffer, open)) {
    if (message->kind == StaffMessage::kCommand || message->kind == StaffMessage::kNote) {
      std::printf("%s %.*s\n", device.name.c_str(), static_cast<int>(message->content.size()),
                  message->content.data());
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: fleet_devices FOLDER [NAME...]\n");
    return 2;
  }
  const std::vector<std::string> names(argv + 2, argv + argc);
  std::vector<std::filesystem::path> folders;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(argv[1]) / "devices")) {
    if (names.empty() ||
        std::find(names.begin(), names.end(), entry.path().filename()) != names.end()) {
      folders.push_back(entry.path());
    }
  }
  std::sort(folders.begin(), folders.end());
  std::vector<std::unique_ptr<SimulatedDevice>> devices;
  for (const std::filesystem::path& folder : folders) {
    devices.push_back(StartDevice(folder));
    if (devices.back() == nullptr) {
      return 1;
    }
  }
  for (size_t i = 0; i < devices.size(); ++i) {
    SendStaffMessage(devices[i]->player, StaffMessage::kDays, PublishedStatistics(StatisticsOf(i)));
  }
  std::string buffer;
  for (double seconds = 0.0;; seconds += kInterval) {
    for (size_t i = 0; i < devices.size(); ++i) {
      const bool silent = i + 1 == devices.size() && devices.size() > 1 && seconds > 0.0;
      if (!silent) {
        SendStaffMessage(devices[i]->player, StaffMessage::kState, StateOf(i, seconds));
      }
      PrintCommands(*devices[i], buffer);
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(kInterval));
  }
}
