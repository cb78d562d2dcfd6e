#include "player/kiosk/power_sensors.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "shared/core/sleep.h"

namespace lararium::player {
namespace {

std::optional<std::string> FirstLine(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  return std::getline(file, line) ? std::optional(line) : std::nullopt;
}

std::optional<double> Number(const std::filesystem::path& path) {
  const std::optional<std::string> line = FirstLine(path);
  if (!line || line->empty()) {
    return std::nullopt;
  }
  char* end = nullptr;
  const double value = std::strtod(line->c_str(), &end);
  return end == line->c_str() ? std::nullopt : std::optional(value);
}

template <typename Visit>
void ForEachFolder(const std::filesystem::path& parent, const std::string& prefix, Visit visit) {
  // Errors end the loop without a report, because devices may disappear while they are listed.
  std::error_code error;
  for (std::filesystem::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().filename().string().rfind(prefix, 0) == 0) {
      visit(entry->path());
    }
  }
}

// Visits the machine's own batteries, not those of a mouse, with the remaining share and Linux's
// word for the status.
template <typename Visit>
void ForEachBattery(const std::filesystem::path& sys, Visit visit) {
  ForEachFolder(sys / "class/power_supply", "", [&](const std::filesystem::path& supply) {
    const std::optional<double> percent = Number(supply / "capacity");
    if (FirstLine(supply / "type") == "Battery" && FirstLine(supply / "scope") != "Device" &&
        percent && *percent >= 0.0 && *percent <= 100.0) {
      visit(*percent / 100.0, FirstLine(supply / "status").value_or(""));
    }
  });
}

// Temperatures outside this range are ignored: sensors that are not connected report such values.
constexpr double kLeastCelsius = 1.0;
constexpr double kMostCelsius = 150.0;

}  // namespace

show::PowerState ReadPower(const std::filesystem::path& sys) {
  show::PowerState power;
  ForEachFolder(sys / "class/thermal", "thermal_zone", [&](const std::filesystem::path& zone) {
    const std::optional<double> thousandths = Number(zone / "temp");
    if (thousandths && *thousandths >= 1e3 * kLeastCelsius && *thousandths <= 1e3 * kMostCelsius) {
      power.celsius = std::max(power.celsius.value_or(0.0), *thousandths / 1000.0);
    }
  });
  ForEachBattery(sys, [&](double share, const std::string& status) {
    if (status == "Discharging") {
      power.battery = std::min(power.battery.value_or(1.0), share);
    }
  });
  return power;
}

std::optional<Battery> ReadBattery(const std::filesystem::path& sys) {
  std::optional<Battery> emptiest;
  ForEachBattery(sys, [&](double share, const std::string& status) {
    if (!emptiest || share < emptiest->share) {
      emptiest = Battery{share, status == "Charging" || status == "Full"};
    }
  });
  return emptiest;
}

PowerWatch::PowerWatch(double seconds_between, Read read)
    : thread_([this, seconds_between, read = std::move(read)](const std::stop_token& stop) {
        Watch(seconds_between, read, stop);
      }) {}

void PowerWatch::Watch(double seconds_between, const Read& read, const std::stop_token& stop) {
  using Clock = std::chrono::steady_clock;
  const auto between =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds_between));
  while (!stop.stop_requested()) {
    power_.Put(read());
    SleepUntil(Clock::now() + between, stop);
  }
}

}  // namespace lararium::player
