#pragma once

// Reads temperature and battery from the files of Linux.

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <thread>

#include "shared/core/mailbox.h"
#include "shared/show/quality_controller.h"

namespace lararium::player {

// sys: usually /sys. Values that are missing or not numbers are unknown.
show::PowerState ReadPower(const std::filesystem::path& sys = "/sys");

struct Battery {
  double share = 0.0;  // remaining charge, 0..1
  bool charging = false;
};
// The battery of the machine with the lowest charge, in use or charging; nullopt: there is none, or
// its charge is unknown.
std::optional<Battery> ReadBattery(const std::filesystem::path& sys = "/sys");

// Reads temperature and battery at intervals on a thread of its own, because drivers of sensors are
// slow.
class PowerWatch {
 public:
  using Read = std::function<show::PowerState()>;

  explicit PowerWatch(
      double seconds_between, Read read = [] { return ReadPower(); });

  // Returns values that were read since the last call, if any. Does not wait.
  std::optional<show::PowerState> Take() { return power_.TryTake(); }

 private:
  void Watch(double seconds_between, const Read& read, const std::stop_token& stop);

  Mailbox<show::PowerState> power_;
  std::jthread thread_;
};

}  // namespace lararium::player
